"""The rows of a unit: what an engine makes of it, whoever asks for it."""

import functools

import numpy as np
import pandas as pd

import tasks
from bench.control.registry import find_compliant
from bench.engines.arm_episode import blank_arm
from bench.engines.contact_episode import Conditions
from bench.engines.disturbed import blank_rows
from bench.engines.episode import blank
from bench.engines.run import run as run_engine
from bench.engines.run_arm import run as run_on_arm
from bench.engines.run_disturbed import run as run_in_trouble
from bench.experiments import contact_rows, robustness_rows
from bench.experiments.contact_plan import ContactUnit, poses_of
from bench.experiments.plan import AnyUnit, Plan, Unit
from bench.experiments.robustness_plan import RobustnessUnit
from bench.experiments.rounding import judged_on_both_sides
from bench.experiments.rows import frame, lost, settings_of
from bench.metrics.registry import metrics_of
from tasks.base import Start


def rows(plan: Plan, unit: AnyUnit) -> pd.DataFrame:
    """The rows of a unit."""
    if isinstance(unit, ContactUnit):
        return _in_contact(plan, unit)
    return _in_trouble(plan, unit) if isinstance(unit, RobustnessUnit) else _episodes(plan, unit)


def _episodes(plan: Plan, unit: Unit) -> pd.DataFrame:
    """The rows of a unit without contact."""
    starts = starts_of(plan, unit)
    one, settings = plan.contender(unit.contender), settings_of(plan, unit.horizon_s)
    metrics = metrics_of(on_arm=one.is_on_arm)
    if not one.is_on_arm:
        numbers = run_engine(unit.engine, one, unit.task, starts, settings, metrics, plan.integrator)
        return frame(plan, unit, one, starts, numbers, metrics)

    def simulated(some: list[Start]) -> pd.DataFrame:
        given = (unit.task, unit.arm, some, settings, metrics, plan.integrator, unit.variation)
        return frame(plan, unit, one, some, run_on_arm(unit.engine, one, *given), metrics)

    return judged_on_both_sides(simulated(starts), starts, simulated)


def lost_rows(plan: Plan, unit: Unit | RobustnessUnit, outcome: str) -> pd.DataFrame:
    """The rows of a unit that a user's law never came back from: what was asked, the outcome, no measure."""
    one = plan.contender(unit.contender)
    metrics = metrics_of(on_arm=one.is_on_arm)
    nothing = dict.fromkeys((metric.column for metric in metrics), np.nan)
    if isinstance(unit, RobustnessUnit):
        simulate = functools.partial(_lost_in_trouble, outcome)
        return _in_trouble(plan, unit, simulate).assign(**nothing, variation=np.nan)
    starts = starts_of(plan, unit)
    blanks = blank_arm(len(starts), metrics) if unit.arm else blank(len(starts), metrics)
    return frame(plan, unit, one, starts, lost(blanks, outcome), metrics).assign(**nothing, cond_jacobian_max=np.nan)


def _lost_in_trouble(outcome, _one, starts, _condition, _settings, metrics, _seed):
    return lost(blank_rows(len(starts), metrics), outcome)


def _in_contact(plan: Plan, unit: ContactUnit) -> pd.DataFrame:
    """The rows of a unit in contact."""
    one, arm = find_compliant(unit.contender), tasks.arm(unit.arm)
    task = tasks.contact_task(unit.task)
    some = poses_of(one, task, arm, unit.dense)[unit.first : unit.first + unit.poses]
    conditions = Conditions(plan.gains, dt_s=plan.dt_s, integrator=plan.contact_integrator)
    return contact_rows.frame(plan.suite, one, task._replace(horizon_s=unit.horizon_s), arm, some, conditions)


def _in_trouble(plan: Plan, unit: RobustnessUnit, simulate=run_in_trouble) -> pd.DataFrame:
    """The rows of a unit along an axis."""
    one, axis = plan.contender(unit.contender), tasks.axis(unit.axis)
    return robustness_rows.frame(plan.suite, one, axis, unit.starts, unit.horizon_s, plan.gains, plan.seed, simulate)


def starts_of(plan: Plan, unit: Unit) -> list[Start]:
    """A unit's stretch of its start set."""
    end = unit.first + unit.count
    if unit.arm:
        return _on_arm(unit.start_set, unit.total, plan.seed, unit.arm)[unit.first : end]
    return tasks.starts_between(unit.start_set, unit.first, end, plan.seed)


_on_arm = functools.lru_cache(maxsize=16)(tasks.start_set)
"""A start set of an arm is searched for, so it is built once for all its units."""
