"""From numbers to rows: a law along an axis of trouble, as rows of robustness.parquet."""

import math

import numpy as np
import pandas as pd

from bench.engines import disturbed
from bench.engines.episode import FAILURE_TICK, FINAL_ANGLE, FIRST_METRIC, NEVER, OUTCOME, SETTLING_TICK, Settings
from bench.engines.run_disturbed import run
from bench.experiments.equal_peak import gains_at
from bench.law.contender import Contender, Gains
from bench.metrics.metric import Ending
from bench.metrics.registry import metrics_of
from tasks.condition import Axis, Condition
from tasks.rules import RULES
from tasks.truth import angle
from tasks.verdict import OUTCOMES


def frame(
    suite: str, one: Contender, axis: Axis, starts: int, horizon_s: float, gains: Gains, seed: int, simulate=run
) -> pd.DataFrame:
    """One row a level and start; none at a level whose command the law has no gains for.

    Args:
        starts: how many at each level; they and the noise are the same for every law.
        simulate: makes the numbers of the rows.
    """
    parts = []
    for level in axis.levels:
        condition = axis.at(level)
        chosen = gains_at(one, condition.peak) if condition.peak else gains
        if chosen is not None:
            some = axis.starts(starts, seed, level)
            rows = _rows(one, some, condition, _settings(chosen, horizon_s), seed, simulate)
            parts.append(pd.DataFrame({"axis": axis.name, "level": level, **rows}))
    if not parts:
        return pd.DataFrame()
    coordinates = one.representation.name if one.representation else ""
    whole = pd.concat(parts, ignore_index=True)
    return whole.assign(suite=suite, regulator=one.regulator.name, representation=coordinates)


def _settings(gains: Gains, horizon_s: float) -> Settings:
    """The judge's rules in ticks of a microsecond, which the condition's own steps replace."""
    return Settings(
        gains,
        1e-6,
        round(1e6 * horizon_s),
        1,
        RULES.command_limit,
        RULES.speed_limit,
        RULES.rest_speed,
        RULES.rest_command,
    )


def _rows(one: Contender, starts, condition: Condition, settings: Settings, seed: int, simulate) -> dict:
    metrics = metrics_of(on_arm=False)
    numbers = simulate(one, starts, condition, settings, metrics, seed)
    step_s = condition.period_s / disturbed.steps_of(condition)
    angle0 = [angle(start.quat_wxyz, start.goal_wxyz) for start in starts]
    outcomes = [OUTCOMES[int(code)] for code in numbers[:, OUTCOME]]
    finals = numbers[:, FINAL_ANGLE]
    endings = [
        Ending(first, last, RULES.band_rad(first), outcome)
        for first, last, outcome in zip(angle0, finals, outcomes, strict=True)
    ]
    measured = {
        metric.column: [metric.finish(value, ending) for value, ending in zip(column.tolist(), endings, strict=True)]
        for metric, column in zip(metrics, numbers[:, FIRST_METRIC:].T, strict=False)
    }
    extra = numbers[:, -disturbed.EXTRA :]
    tail = extra[:, disturbed.TAIL_COUNT]
    has_tail = tail > 0
    rms = np.sqrt(extra[:, disturbed.TAIL_SQUARES] / np.where(has_tail, tail, 1.0))
    return {
        "start_id": [start.id for start in starts],
        "angle0_rad": angle0,
        "kp": settings.gains.kp,
        "kv": settings.gains.kv,
        "dt_s": condition.period_s,
        "horizon_s": settings.ticks * settings.dt_s,
        "outcome": outcomes,
        "settling_time_s": _time(numbers[:, SETTLING_TICK], step_s),
        "failure_time_s": _time(numbers[:, FAILURE_TICK], step_s),
        "final_angle_rad": finals,
        **measured,
        "tail_rms_rad": np.where(has_tail, rms, finals),
        "tail_max_rad": np.where(has_tail, extra[:, disturbed.TAIL_WORST], finals),
        "variation": extra[:, disturbed.VARIATION],
    }


def _time(ticks: np.ndarray, step_s: float) -> np.ndarray:
    return np.where(ticks == NEVER, math.nan, ticks * step_s)
