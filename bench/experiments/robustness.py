"""Laws of the free body under perturbations (tasks/conditions): a unit a law and perturbation."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING

import tasks
from bench.contenders.registry import papers_laws
from bench.errors import Incompatible
from bench.experiments.choice import Choice
from bench.experiments.experiment import OF_LAWS, Asked, Experiment, Settings, Unit
from bench.experiments.suites import Robustness
from bench.law.contender import Contender
from bench.tables.schema import TABLES

if TYPE_CHECKING:
    import pandas as pd

HORIZON_S = 5.0
"""Longest simulated time [s]: eight settling times of a small error, and a tail to average over."""

SHORTEST_S = 1e-4
"""Control period at the highest rate."""

EPISODE_S = 6e-4
"""CPU seconds an episode, see `free_body`."""


@functools.lru_cache(maxsize=8)
def units(asked: Asked) -> tuple[Unit, ...]:
    """The units of a suite's part, narrowed or widened by what the user named; `count` starts at each level.

    Errors:
        Incompatible: perturbations are named and no law that can meet them.
    """
    part, choice = asked.suite.robustness, asked.choice
    if choice.tasks and "free-body" not in choice.tasks:
        return ()
    chosen = [one for one in asked.laws if _takes_part(one, part, choice)]
    if choice.axes and not chosen:
        usual = papers_laws()[0].name
        raise Incompatible(f"nothing to run: along an axis go laws of the free body (try: --regulator {usual})")
    axes = [tasks.axis(name) for name in choice.axes or tasks.axis_names()]
    each, horizon_s = asked.count or part.starts, asked.horizon_s or HORIZON_S
    return tuple(
        Unit(
            "robustness",
            one.name,
            selector=axis.name,
            count=each,
            total=each,
            episodes=each * len(axis.levels),
            horizon_s=horizon_s,
        )
        for one in chosen
        for axis in axes
    )


def _takes_part(one: Contender, part: Robustness, choice: Choice) -> bool:
    """Whether it is a law on R or on the paper's coordinates, a user's, or named; and no actuator of MuJoCo's."""
    is_wanted = bool(one.regulator.origin or choice.regulators or choice.representations)
    is_usual = not one.is_elsewhere or part.others is None or one.name in part.others
    return (is_wanted or is_usual) and not one.regulator.in_engine


def rows(settings: Settings, unit: Unit) -> pd.DataFrame:
    """One row a level and start; none at a level whose command the law has no gains for."""
    from bench.engines.simulate_perturbed import run_disturbed as run
    from bench.experiments.rows.robustness import frame

    return frame(settings, unit, run)


def prepare(settings: Settings, unit: Unit) -> None:
    """Compile the loop and the law."""
    from bench.engines.simulate import compiled_loop, evaluation
    from bench.metrics.registry import metrics_of

    compiled_loop("perturbed", tuple(metrics_of(on_arm=False)))
    evaluation(settings.contender(unit.contender))


def lost(settings: Settings, unit: Unit, outcome: str) -> pd.DataFrame:
    """What was asked, the outcome, no measure."""
    from bench.experiments.rows.robustness import lost_frame

    return lost_frame(settings, unit, outcome)


EXPERIMENT = Experiment(
    "robustness",
    "laws on the free body under perturbations",
    TABLES["robustness"],
    units,
    rows,
    takes=(*OF_LAWS, "axes"),
    cost_s=lambda unit: unit.episodes * EPISODE_S,
    prepare=prepare,
    lost=lost,
    ticks=lambda settings, unit: unit.episodes * unit.horizon_s / SHORTEST_S,
    rank=3,
)
