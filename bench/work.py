"""The rows of a unit: what an engine makes of it, whoever asks for it."""

import functools

import pandas as pd

import tasks
from bench import contact_rows, robustness_rows
from bench.contact_plan import ContactUnit, poses_of
from bench.discovery import find_compliant, metrics_of
from bench.engines.contact_episode import Conditions
from bench.engines.run import run as run_engine
from bench.engines.run_arm import run as run_on_arm
from bench.plan import AnyUnit, Plan, Unit
from bench.robustness_plan import RobustnessUnit
from bench.rows import frame, settings_of
from tasks.base import Start


def rows(plan: Plan, unit: AnyUnit) -> pd.DataFrame:
    """The rows of a unit."""
    if isinstance(unit, ContactUnit):
        return _in_contact(plan, unit)
    return _in_trouble(plan, unit) if isinstance(unit, RobustnessUnit) else _episodes(plan, unit)


def _episodes(plan: Plan, unit: Unit) -> pd.DataFrame:
    """The rows of a unit without contact."""
    starts = _starts_of(plan, unit)
    one, settings = plan.contender(unit.contender), settings_of(plan, unit.horizon_s)
    metrics = metrics_of(on_arm=one.is_on_arm)
    if one.is_on_arm:
        given = (unit.task, unit.arm, starts, settings, metrics, plan.integrator, unit.variation)
        numbers = run_on_arm(unit.engine, one, *given)
    else:
        numbers = run_engine(unit.engine, one, unit.task, starts, settings, metrics, plan.integrator)
    return frame(plan, unit, one, starts, numbers, metrics)


def _in_contact(plan: Plan, unit: ContactUnit) -> pd.DataFrame:
    """The rows of a unit in contact."""
    one, arm = find_compliant(unit.contender), tasks.arm(unit.arm)
    task = tasks.contact_task(unit.task)
    some = poses_of(one, task, arm, unit.dense)[unit.first : unit.first + unit.poses]
    conditions = Conditions(plan.gains, dt_s=plan.dt_s, integrator=plan.contact_integrator)
    return contact_rows.frame(plan.suite, one, task._replace(horizon_s=unit.horizon_s), arm, some, conditions)


def _in_trouble(plan: Plan, unit: RobustnessUnit) -> pd.DataFrame:
    """The rows of a unit along an axis."""
    one, axis = plan.contender(unit.contender), tasks.axis(unit.axis)
    return robustness_rows.frame(plan.suite, one, axis, unit.starts, unit.horizon_s, plan.gains, plan.seed)


def _starts_of(plan: Plan, unit: Unit) -> list[Start]:
    """A unit's stretch of its start set."""
    end = unit.first + unit.count
    if unit.arm:
        return _on_arm(unit.start_set, unit.total, plan.seed, unit.arm)[unit.first : end]
    return tasks.starts_between(unit.start_set, unit.first, end, plan.seed)


_on_arm = functools.lru_cache(maxsize=16)(tasks.start_set)
"""A start set of an arm is searched for, so it is built once for all its units."""
