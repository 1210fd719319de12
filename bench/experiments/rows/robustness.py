"""From numbers to rows: a law under a perturbation, as rows of robustness.parquet."""

import numpy as np
import pandas as pd

import tasks
from bench.engines.episode import Settings as Limits
from bench.engines.plants import perturbed
from bench.experiments.experiment import Settings, Unit
from bench.experiments.rows.episodes import judged_columns, lost, measured_columns
from bench.experiments.rows.equal_peak import gains_at
from bench.law.contender import Contender, Gains
from bench.metrics.registry import metrics_of
from tasks.condition import Condition
from tasks.truth import angle


def frame(settings: Settings, unit: Unit, simulate, gains=gains_at) -> pd.DataFrame:
    """One row a level and start; none at a level whose command the law has no gains for.

    The starts and the noise are the same for every law.

    Args:
        simulate: makes the numbers of the rows, as `run_disturbed`. gains(law, peak): those that give the peak.
    """
    one, axis, seed = settings.contender(unit.contender), tasks.axis(unit.selector), settings.seed
    parts = []
    for level in axis.levels:
        condition = axis.at(level)
        chosen = gains(one, condition.peak) if condition.peak else settings.gains
        if chosen is not None:
            some = axis.starts(unit.count, seed, level)
            rows = _rows(one, some, condition, _limits(chosen, unit.horizon_s), seed, simulate)
            parts.append(pd.DataFrame({"axis": axis.name, "level": level, **rows}))
    if not parts:
        return pd.DataFrame()
    coordinates = one.representation.name if one.representation else ""
    whole = pd.concat(parts, ignore_index=True)
    return whole.assign(suite=settings.suite, regulator=one.regulator.name, representation=coordinates)


def lost_frame(settings: Settings, unit: Unit, outcome: str) -> pd.DataFrame:
    """The rows of a unit that a user's law never came back from: what was asked, the outcome, no measure.

    Gains that give a peak are the law's to say; the row has the run's.
    """

    def simulate(_one, starts, _condition, _limits, metrics, _seed):
        return lost(perturbed.blank_rows(len(starts), metrics), outcome)

    nothing = dict.fromkeys((metric.column for metric in metrics_of(on_arm=False)), np.nan)
    return frame(settings, unit, simulate, lambda _one, _peak: settings.gains).assign(**nothing, variation=np.nan)


def _limits(gains: Gains, horizon_s: float) -> Limits:
    """The judge's rules in ticks of a microsecond, which the condition's own steps replace."""
    return Limits(gains, 1e-6, round(1e6 * horizon_s), 1)


def _rows(one: Contender, starts, condition: Condition, limits: Limits, seed: int, simulate) -> dict:
    metrics = metrics_of(on_arm=False)
    numbers = simulate(one, starts, condition, limits, metrics, seed)
    step_s = condition.period_s / perturbed.steps_of(condition)
    angle0 = [angle(start.quat_wxyz, start.goal_wxyz) for start in starts]
    judged = judged_columns(numbers, step_s)
    finals = judged["final_angle_rad"]
    extra = numbers[:, -perturbed.EXTRA :]
    tail = extra[:, perturbed.TAIL_COUNT]
    has_tail = tail > 0
    rms = np.sqrt(extra[:, perturbed.TAIL_SQUARES] / np.where(has_tail, tail, 1.0))
    return {
        "start_id": [start.id for start in starts],
        "angle0_rad": angle0,
        "kp": limits.gains.kp,
        "kv": limits.gains.kv,
        "dt_s": condition.period_s,
        "horizon_s": limits.ticks * limits.dt_s,
        **judged,
        **measured_columns(numbers, metrics, angle0, judged),
        "tail_rms_rad": np.where(has_tail, rms, finals),
        "tail_max_rad": np.where(has_tail, extra[:, perturbed.TAIL_WORST], finals),
        "variation": extra[:, perturbed.VARIATION],
    }
