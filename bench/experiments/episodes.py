"""Episodes without contact, for `free_body` and `arm`: slices of a suite cut into units, and a unit's rows."""

from __future__ import annotations

import dataclasses
import functools
import importlib
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

import tasks
from bench.base.on_first_use import pd
from bench.engines.metrics.registry import metrics_of
from bench.experiments import starts
from bench.experiments.episode_rows import frame, lost_frame
from bench.experiments.experiment import Unit
from bench.experiments.request import Request
from bench.experiments.suites import IDEAL_MOTORS
from bench.law.contender import Contender
from tasks.base import Start

if TYPE_CHECKING:
    from bench.engines.curve import Curves
    from bench.engines.metrics.metric import Metric


def tasks_of(request: Request) -> tuple[str, ...]:
    """Return the tasks without contact that are meant."""
    if request.tasks:
        return tuple(word for word in request.tasks if word in tasks.names())
    return tuple(word for word in tasks.names() if tasks.is_for_arms(word) or not request.is_about_arms)


def runs_on(engine: str, task: str, contender: Contender) -> bool:
    """Tell whether an engine can run a task: the ideal plant is a free body without actuators of MuJoCo."""
    return not engine.startswith("ideal") or (task == "free-body" and not contender.regulator.in_engine)


def split_into_units(whole: Iterable[Unit], request: Request, most: dict[str, int]) -> Iterator[Unit]:
    """Yield the units of slices that have a contender and a task, of at most so many episodes each by engine."""
    count_starts = functools.cache(lambda word, size, arm: starts.count_of(word, size, request.seed, arm))
    for unit in whole:
        count = count_starts(unit.selector, request.count or unit.total or None, unit.arm)
        horizon_s = request.horizon_s or unit.horizon_s
        yield from dataclasses.replace(unit, total=count, horizon_s=horizon_s).cut(count, most[unit.engine])


def starts_of(request: Request, unit: Unit) -> list[Start]:
    """Return a unit's stretch of its start set."""
    end = unit.first + unit.count
    if unit.arm:
        return starts.on_arm(unit.selector, unit.total, request.seed, unit.arm)[unit.first : end]
    return tasks.starts_between(unit.selector, unit.first, end, request.seed)


def simulate(request: Request, unit: Unit, some: list[Start], horizon_s: float, curves: Curves | None = None) -> Any:
    """Return what an engine gives back of a unit's contender from these starts, on the free body or its arm."""
    one, limits, metrics = request.contender(unit.contender), request.limits(horizon_s), metrics_of(bool(unit.arm))
    if unit.arm:
        from bench.engines.simulate_arms import run_arm

        given = (some, limits, metrics, request.integrator, unit.variation or IDEAL_MOTORS, curves)
        return run_arm(unit.engine, one, unit.task, unit.arm, *given)
    from bench.engines.simulate import run

    return run(unit.engine, one, unit.task, some, limits, metrics, request.integrator, curves, unit.total)


def rows_from(request: Request, unit: Unit, some: list[Start]) -> pd.DataFrame:
    """Return the rows of a unit from these starts."""
    return frame(request, unit, some, simulate(request, unit, some, unit.horizon_s))


def prepare(request: Request, unit: Unit) -> None:
    """Build the starts, and compile the loop and the contender."""
    if unit.selector:
        starts_of(request, unit)
    metrics = tuple(metrics_of(on_arm=bool(unit.arm)))
    if unit.engine == "reference":
        importlib.import_module("tasks.episode")
    elif unit.arm:
        from bench.engines import simulate_arms

        simulate_arms.compiled_loop("arm", metrics)
        simulate_arms.pointers(request.contender(unit.contender))
    else:
        prepare_law(request, unit, unit.engine, metrics)


def prepare_law(request: Request, unit: Unit, engine: str, metrics: tuple[Metric, ...]) -> None:
    """Compile an engine's loop and the contender."""
    from bench.engines import simulate

    simulate.prepare(engine, request.contender(unit.contender), metrics, unit.total)


def lost(request: Request, unit: Unit, outcome: str) -> pd.DataFrame:
    """Return rows with the numbers of the request and the outcome, and no measure."""
    return lost_frame(request, unit, starts_of(request, unit), outcome)
