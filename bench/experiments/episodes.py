"""Episodes without contact, for `free_body` and `arm`: a suite's slices as the user narrows them, cut into units."""

from __future__ import annotations

import functools
import importlib
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import tasks
from bench.base.errors import Incompatible
from bench.base.on_first_use import pd
from bench.engines.metrics.registry import metrics_of
from bench.experiments import starts
from bench.experiments.choice import Choice
from bench.experiments.episode_rows import frame, lost_frame
from bench.experiments.experiment import Asked, Settings, Unit
from bench.experiments.suites import HORIZON, IDEAL_MOTORS, NOMINAL, ON_ARM, SHORT, Slice
from bench.law.contender import Contender
from tasks.base import Start

if TYPE_CHECKING:
    from bench.engines.curve import Curves
    from bench.engines.metrics.metric import Metric


class Place(NamedTuple):
    """A contender on a slice of a task: what is cut into units."""

    part: Slice
    contender: Contender
    task: str
    arm: str = ""
    variation: str = NOMINAL
    gains: tuple[float, float] = (0.0, 0.0)


def tasks_of(asked: Asked) -> tuple[str, ...]:
    """Return the tasks without contact that are meant."""
    choice = asked.choice
    if choice.tasks:
        return tuple(word for word in choice.tasks if word in tasks.names())
    return tuple(word for word in tasks.names() if tasks.is_for_arms(word) or not choice.is_about_arms)


def runs_on(engine: str, task: str, one: Contender) -> bool:
    """Tell whether an engine can run a task: the ideal plant is a free body without actuators of MuJoCo."""
    return not engine.startswith("ideal") or (task == "free-body" and not one.regulator.in_engine)


def narrowed(slices: tuple[Slice, ...], choice: Choice) -> tuple[Slice, ...]:
    """Return the start sets and engines that are named, with the suite's sizes where it has some."""
    if not choice.narrows:
        return slices
    sizes = {(part.engine, part.start_set): part for part in slices}
    wanted_engines = choice.engines or tuple(dict.fromkeys(part.engine for part in slices))
    wanted_sets = choice.start_sets or tuple(dict.fromkeys(part.start_set for part in slices))
    horizons = dict.fromkeys((part.start_set for part in slices if part.horizon_s == ON_ARM), ON_ARM)
    return tuple(
        sizes.get((engine, name)) or Slice(engine, name, None, horizons.get(name) or HORIZON.get(name, SHORT))
        for engine in wanted_engines
        for name in wanted_sets
        if not (engine == "reference" and not choice.engines and (engine, name) not in sizes)
    )


def cut(experiment: str, places: list[Place], asked: Asked, most: dict[str, int]) -> Iterator[Unit]:
    """Return the units of places, of at most so many episodes each by engine."""
    number = functools.cache(lambda word, size, arm: starts.count_of(word, size, asked.seed, arm))
    for part, one, task, arm, variation, gains in places:
        total, horizon_s = number(part.start_set, asked.count or part.size, arm), asked.horizon_s or part.horizon_s
        where = experiment, one.name, task, arm, part.engine, part.start_set, variation
        yield from Unit(*where, 0, 0, total, 0, horizon_s, *gains).cut(total, most[part.engine])


def refuse_if_none(asked: Asked, units: tuple[Unit, ...]) -> None:
    """Say why no task, engine and start set go together, if some are meant and there is not one unit."""
    every_task = tasks_of(asked)
    if units or not every_task:
        return
    reasons, suite, choice = [], asked.suite, asked.choice
    for task in every_task:
        is_for_arms = tasks.is_for_arms(task)
        allowed = tasks.start_set_names(arm=True) if is_for_arms else tasks.task(task).start_sets
        slices = narrowed(suite.on_arms.slices if is_for_arms else suite.slices, choice)
        refused = [part.engine for part in slices if not any(runs_on(part.engine, task, one) for one in asked.laws)]
        if refused:
            what = f"free-body alone, not '{task}'" if task != "free-body" else "no actuator of MuJoCo"
            reasons.append(f"{', '.join(dict.fromkeys(refused))} simulates {what}")
        foreign = [part.start_set for part in slices if part.start_set not in allowed]
        if foreign:
            reasons.append(
                f"task '{task}' takes the starts {', '.join(allowed)}, not {', '.join(dict.fromkeys(foreign))}"
            )
    raise Incompatible(f"nothing to run: {'; '.join(reasons)} (choose another --task, --engine or --starts)")


def starts_of(settings: Settings, unit: Unit) -> list[Start]:
    """Return a unit's stretch of its start set."""
    end = unit.first + unit.count
    if unit.arm:
        return starts.on_arm(unit.selector, unit.total, settings.seed, unit.arm)[unit.first : end]
    return tasks.starts_between(unit.selector, unit.first, end, settings.seed)


def simulate(settings: Settings, unit: Unit, some: list[Start], horizon_s: float, curves: Curves | None = None) -> Any:
    """Return what an engine gives back of a unit's contender from these starts, on the free body or its arm."""
    one, limits, metrics = settings.contender(unit.contender), settings.limits(horizon_s), metrics_of(bool(unit.arm))
    if unit.arm:
        from bench.engines.simulate_arms import run_arm

        given = (some, limits, metrics, settings.integrator, unit.variation or IDEAL_MOTORS, curves)
        return run_arm(unit.engine, one, unit.task, unit.arm, *given)
    from bench.engines.simulate import run

    return run(unit.engine, one, unit.task, some, limits, metrics, settings.integrator, curves, unit.total)


def rows_from(settings: Settings, unit: Unit, some: list[Start]) -> pd.DataFrame:
    """Return the rows of a unit from these starts."""
    return frame(settings, unit, some, simulate(settings, unit, some, unit.horizon_s))


def prepare(settings: Settings, unit: Unit) -> None:
    """Build the starts, and compile the loop and the contender."""
    if unit.selector:
        starts_of(settings, unit)
    metrics = tuple(metrics_of(on_arm=bool(unit.arm)))
    if unit.engine == "reference":
        importlib.import_module("tasks.episode")
    elif unit.arm:
        from bench.engines import simulate_arms

        simulate_arms.compiled_loop("arm", metrics)
        simulate_arms.pointers(settings.contender(unit.contender))
    else:
        prepare_law(settings, unit, unit.engine, metrics)


def prepare_law(settings: Settings, unit: Unit, engine: str, metrics: tuple[Metric, ...]) -> None:
    """Compile an engine's loop and the contender."""
    from bench.engines import simulate

    simulate.prepare(engine, settings.contender(unit.contender), metrics, unit.total)


def lost(settings: Settings, unit: Unit, outcome: str) -> pd.DataFrame:
    """Return the settings and the outcome, no measure."""
    return lost_frame(settings, unit, starts_of(settings, unit), outcome)
