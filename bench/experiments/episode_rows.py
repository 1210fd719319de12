"""Rows of episodes without contact: their columns, and how they are made of what an engine gives back.

    outcome, settling_time_s,         `judged_columns`, from the judge (tasks/verdict.py)
    failure_time_s, final_angle_rad
    effort, overshoot_rad, and more   `measured_columns`: one a metric (bench/engines/metrics/motion)
    cause, cond_jacobian_max          `frame`, from tasks/cause.py and tasks/kinematics.py
    all others                        `frame`, from the request, the unit and the starts

episodes.toml declares the columns; JUDGED, and other names in capitals, are in shared.toml.
"""

from __future__ import annotations

import math

import numpy as np

import tasks
from bench.base.on_first_use import pd
from bench.engines import episode
from bench.engines.arm_episode import POSE, blank_arm
from bench.engines.metrics.metric import Ending, Metric
from bench.engines.metrics.registry import known_metrics, metrics_of
from bench.experiments.columns import of_metrics, read_table
from bench.experiments.experiment import Unit
from bench.experiments.request import Request
from bench.experiments.rounding import OUTCOME_NUDGED, ROUNDING_CHANGE
from bench.law.contenders.representations.zyx_euler import chart
from bench.law.so3 import from_quaternion
from tasks.base import Start
from tasks.cause import cause
from tasks.rules import RULES
from tasks.truth import angle
from tasks.verdict import OUTCOMES

INTEGRATORS = {"ideal-rk4": "rk4", "ideal-held": "magnus4"}


TABLE = read_table(__file__, "episodes", METRICS=lambda: of_metrics(known_metrics().values()))
"""The table of `free_body` and `arm`."""


def frame(request: Request, unit: Unit, starts: list[Start], numbers: np.ndarray) -> pd.DataFrame:
    """Return the rows of one unit from these starts."""
    angles = np.array([chart(from_quaternion(start.quat_wxyz)).E for start in starts])
    quats = np.array([start.quat_wxyz for start in starts])
    omegas = np.array([start.omega for start in starts])
    goals = np.array([start.goal_wxyz for start in starts])
    ran = episode_columns(request, starts, numbers, request.dt_s, unit.horizon_s)
    found = {
        **ran,
        "task": unit.task,
        "arm": unit.arm,
        "variation": unit.variation,
        **request.contender(unit.contender).words,
        "engine": unit.engine,
        "start_set": unit.selector,
        **{f"quat_{axis}": quats[:, i] for i, axis in enumerate("wxyz")},
        **{name: angles[:, i] for i, name in enumerate(("alpha0", "beta0", "gamma0"))},
        **{f"omega0_{axis}": omegas[:, i] for i, axis in enumerate("xyz")},
        **{f"goal_quat_{axis}": goals[:, i] for i, axis in enumerate("wxyz")},
        "kp": request.gains.kp,
        "kv": request.gains.kv,
        "integrator": INTEGRATORS.get(unit.engine, request.integrator),
        **_steps(numbers, request.dt_s),
        "tolerance": RULES.tolerance,
        "hold_s": RULES.hold_s,
        "ticks": numbers[:, episode.TICKS].astype(np.int64),
    }
    found |= measured_columns(numbers, metrics_of(on_arm=bool(unit.arm)), ran)
    seen = _seen_on_arm(unit.arm, numbers) if unit.arm else np.full(len(starts), np.nan)
    margins = found["min_margin"]
    return pd.DataFrame(
        {
            **dict.fromkeys((one.column for one in known_metrics().values()), np.nan),
            **found,
            "cond_jacobian_max": seen,
            "cause": [cause(*near) if unit.arm else "" for near in zip(ran["outcome"], margins, seen, strict=True)],
            OUTCOME_NUDGED: "",
            ROUNDING_CHANGE: np.nan,
        }
    )


def lost_frame(request: Request, unit: Unit, starts: list[Start], outcome: str) -> pd.DataFrame:
    """Return rows of episodes that a user's law never came back from: numbers and outcome, but no measure."""
    metrics = metrics_of(on_arm=bool(unit.arm))
    numbers = lost_numbers((blank_arm if unit.arm else episode.blank)(len(starts), metrics), outcome)
    made = frame(request, unit, starts, numbers)
    return made.assign(**dict.fromkeys((metric.column for metric in metrics), np.nan), cond_jacobian_max=np.nan)


def lost_numbers(numbers: np.ndarray, outcome: str) -> np.ndarray:
    """Turn blank rows of `engines.episode` into those of episodes that a user's law never came back from."""
    numbers[:, episode.OUTCOME] = OUTCOMES.index(outcome)
    numbers[:, [episode.SETTLING_TICK, episode.FAILURE_TICK]] = episode.NEVER
    numbers[:, episode.FINAL_ANGLE] = np.nan
    return numbers


def episode_columns(request: Request, starts: list[Start], numbers: np.ndarray, dt_s: float, horizon_s: float) -> dict:
    """Return what rows of several experiments say: the start of an episode, its times, and how it ended."""
    return {
        "suite": request.suite,
        "start_id": [start.id for start in starts],
        "angle0_rad": np.array([angle(start.quat_wxyz, start.goal_wxyz) for start in starts]),
        "dt_s": dt_s,
        "horizon_s": horizon_s,
        **judged_columns(numbers, dt_s),
    }


def judged_columns(numbers: np.ndarray, dt_s: float) -> dict:
    """Return the values of the columns JUDGED, from rows of `engines.episode`."""
    return {
        "outcome": [OUTCOMES[int(code)] for code in numbers[:, episode.OUTCOME]],
        "settling_time_s": _time(numbers[:, episode.SETTLING_TICK], dt_s),
        "failure_time_s": _time(numbers[:, episode.FAILURE_TICK], dt_s),
        "final_angle_rad": numbers[:, episode.FINAL_ANGLE],
    }


def measured_columns(numbers: np.ndarray, metrics: tuple[Metric, ...], ran: dict) -> dict:
    """Return the columns of the metrics, each finished by how its episode began and ended (`episode_columns`)."""
    endings = [
        Ending(start, final, RULES.band_rad(start), outcome)
        for start, final, outcome in zip(
            ran["angle0_rad"].tolist(), ran["final_angle_rad"], ran["outcome"], strict=True
        )
    ]
    return {
        metric.column: [metric.finish(value, ending) for value, ending in zip(column.tolist(), endings, strict=True)]
        for metric, column in zip(metrics, numbers[:, episode.FIRST_METRIC :].T, strict=False)
    }


def _steps(numbers: np.ndarray, dt_s: float) -> dict:
    """Return the step of integration, and whether it was short enough where that was asked (`engines.convergence`)."""
    step_s = numbers[:, episode.STEP]
    return {
        "step_s": np.where(step_s == 0.0, dt_s, np.abs(step_s)),
        "converged": np.select([step_s > 0.0, step_s < 0.0], ["yes", "no"], ""),
    }


def _seen_on_arm(arm: str, numbers: np.ndarray) -> list[float]:
    """Return the judge's condition number where each episode was worst conditioned; infinite where angles are NaN."""
    from tasks.kinematics import kinematics  # MuJoCo takes a moment to import; the ideal plant needs none

    judge = kinematics(tasks.arm(arm))
    poses = numbers[:, POSE + 1 :][:, : tasks.arm(arm).joints]
    return [judge.condition(q) if np.isfinite(q).all() else math.inf for q in poses]


def _time(ticks: np.ndarray, dt_s: float) -> np.ndarray:
    return np.where(ticks == episode.NEVER, np.nan, ticks * dt_s)
