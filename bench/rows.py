"""From numbers to rows: what an engine gives back, as columns of episodes.parquet."""

import math

import numpy as np
import pandas as pd

from bench.contender import Contender
from bench.engines.episode import (
    FAILURE_TICK,
    FINAL_ANGLE,
    FIRST_METRIC,
    NEVER,
    OUTCOME,
    SETTLING_TICK,
    TICKS,
    Settings,
)
from bench.metric import Ending
from bench.plan import Plan, Unit
from bench.representations.zyx_euler import chart
from bench.so3 import from_quaternion
from tasks.rules import RULES
from tasks.truth import angle
from tasks.verdict import OUTCOMES

INTEGRATORS = {"ideal-rk4": "rk4", "ideal-held": "magnus4"}


def settings_of(plan: Plan, horizon_s: float) -> Settings:
    """The judge's rules and the plan's numbers, as engines take them."""
    return Settings(
        plan.gains,
        plan.dt_s,
        max(1, math.floor(horizon_s / plan.dt_s + 0.5)),
        RULES.hold_ticks(plan.dt_s),
        RULES.command_limit,
        RULES.speed_limit,
        RULES.rest_speed,
        RULES.rest_command,
    )


def contender_columns(one: Contender) -> dict:
    """The columns that say which law a row is about."""
    coordinates = one.representation.name if one.representation else ""
    return {"regulator": one.regulator.name, "representation": coordinates, "jacobian": "", "inverse": ""}


def frame(plan: Plan, unit: Unit, contender: Contender, starts, numbers: np.ndarray, metrics) -> pd.DataFrame:
    """The rows of one unit."""
    angles = np.array([chart(from_quaternion(start.quat_wxyz)).E for start in starts])
    quats = np.array([start.quat_wxyz for start in starts])
    omegas = np.array([start.omega for start in starts])
    goals = np.array([start.goal_wxyz for start in starts])
    angle0 = [angle(start.quat_wxyz, start.goal_wxyz) for start in starts]
    outcomes = [OUTCOMES[int(code)] for code in numbers[:, OUTCOME]]
    columns = {
        "suite": plan.suite,
        "task": unit.task,
        "arm": "",
        **contender_columns(contender),
        "engine": unit.engine,
        "start_set": unit.start_set,
        "start_id": [start.id for start in starts],
        **{f"quat_{axis}": quats[:, i] for i, axis in enumerate("wxyz")},
        **{name: angles[:, i] for i, name in enumerate(("alpha0", "beta0", "gamma0"))},
        "angle0_rad": angle0,
        **{f"omega0_{axis}": omegas[:, i] for i, axis in enumerate("xyz")},
        **{f"goal_quat_{axis}": goals[:, i] for i, axis in enumerate("wxyz")},
        "kp": plan.gains.kp,
        "kv": plan.gains.kv,
        "dt_s": plan.dt_s,
        "integrator": INTEGRATORS.get(unit.engine, plan.integrator),
        "horizon_s": unit.horizon_s,
        "tolerance": RULES.tolerance,
        "hold_s": RULES.hold_s,
        "outcome": outcomes,
        "settling_time_s": _time(numbers[:, SETTLING_TICK], plan.dt_s),
        "failure_time_s": _time(numbers[:, FAILURE_TICK], plan.dt_s),
        "final_angle_rad": numbers[:, FINAL_ANGLE],
        "ticks": numbers[:, TICKS].astype(np.int64),
    }
    endings = [
        Ending(start, final, RULES.band_rad(start), outcome)
        for start, final, outcome in zip(angle0, numbers[:, FINAL_ANGLE], outcomes, strict=True)
    ]
    for column, metric in enumerate(metrics, start=FIRST_METRIC):
        columns[metric.column] = [
            metric.finish(value, ending) for value, ending in zip(numbers[:, column].tolist(), endings, strict=True)
        ]
    return pd.DataFrame(columns)


def _time(ticks: np.ndarray, dt_s: float) -> np.ndarray:
    return np.where(ticks == NEVER, np.nan, ticks * dt_s)
