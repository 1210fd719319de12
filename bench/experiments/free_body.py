"""Episodes of the body that turns freely: every law, from the suite's start sets, on each of its engines."""

from __future__ import annotations

import functools

import tasks
from bench.base.on_first_use import pd
from bench.experiments import arm, episodes
from bench.experiments.episode_rows import TABLE
from bench.experiments.experiment import OF_EPISODES, Asked, Experiment, Settings, Unit
from bench.experiments.suites import Slice, Suite
from bench.law.contender import Contender

MOST = {"ideal-rk4": 1000, "ideal-held": 1000, "native": 250, "reference": 4}
"""Episodes a unit at most: a few seconds each even if none of them settles, so that Ctrl-C answers soon."""

EPISODE_S = {"ideal-rk4": 4e-4, "ideal-held": 2e-4, "native": 3e-3, "reference": 0.06}
"""Median CPU seconds an episode, of six units of each kind on a core of 2026, to one digit; compiling is extra."""


@functools.lru_cache(maxsize=8)
def units(asked: Asked) -> tuple[Unit, ...]:
    """Return the units of a suite's slices; Incompatible where no named task, engine and start set go together."""
    places = [
        episodes.Place(part, one, task)
        for task in episodes.tasks_of(asked)
        if not tasks.is_for_arms(task)
        for one in asked.laws
        for part in episodes.narrowed(slices_of(asked.suite, one), asked.choice)
        if part.start_set in tasks.task(task).start_sets and episodes.runs_on(part.engine, task, one)
    ]
    found = tuple(episodes.cut("free-body", places, asked, MOST))
    episodes.refuse_if_none(asked, found or arm.units(asked))
    return found


def slices_of(suite: Suite, one: Contender) -> tuple[Slice, ...]:
    """Return the slices of a suite that a contender runs on."""
    if one.regulator.in_engine:
        return suite.in_engine
    return suite.beyond if one.is_beyond_the_paper else suite.slices


def rows(settings: Settings, unit: Unit) -> pd.DataFrame:
    """Return the rows of a unit."""
    return episodes.rows_from(settings, unit, episodes.starts_of(settings, unit))


EXPERIMENT = Experiment.of(
    globals(),
    "laws on the body that turns freely",
    table=TABLE,
    takes=OF_EPISODES,
    cost_s=lambda unit: unit.count * EPISODE_S[unit.engine],
    prepare=episodes.prepare,
    lost=episodes.lost,
    is_divisible=True,
    rank=0,
)
