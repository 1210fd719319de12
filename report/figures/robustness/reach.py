"""How far each law goes along each perturbation before it gives way.

A law gives way at the first level, walking away from none, at which LOST fewer of the starts go well than unperturbed,
or at which its median settling time is more than SLOWED of what it was. A law from which less than half of the starts
go well without any perturbation has nothing to lose: it fails.
"""

from __future__ import annotations

import functools
from typing import NamedTuple

import pandas as pd

import tasks
from report.figures.kit.page import Run
from report.figures.robustness.rows import LASTING, along, laws, levels, median, nominal, of

LOST, SLOWED = 0.05, 1.5
TIMELESS = (*LASTING, "half-turn-noise")
"""Perturbations under which only the share counts: that never end, or that wait at the half turn."""


class Walk(NamedTuple):
    """One way along one perturbation.

    title: over the column, with its unit. words: in a sentence. outwards: towards larger levels, or smaller ones.
    """

    axis: str
    title: str
    words: str
    outwards: bool = True


WALKS: tuple[Walk, ...] = (
    Walk("control-rate", "slow control [Hz]", "slow control", outwards=False),
    Walk("delay", "delay [s]", "delay"),
    Walk("attitude-noise", "attitude noise [rad]", "noise on the orientation"),
    Walk("rate-noise", "rate noise [rad/s]", "noise on the rate"),
    Walk("half-turn-noise", "half-turn noise [rad]", "the worst noise at the half turn"),
    Walk("saturation", "bound [rad/s²]", "a bound on the command", outwards=False),
    Walk("inertia", "lighter body", "a lighter body", outwards=False),
    Walk("inertia", "heavier body", "a heavier body"),
    Walk("uneven-inertia", "uneven body", "an uneven body"),
    Walk("spin", "spin [rad/s]", "initial spin"),
    Walk("moving-goal", "moving goal, all told [rad/s]", "a moving goal of which all is told"),
    Walk("moving-goal-rate", "its rate told [rad/s]", "a moving goal of which the rate is told"),
    Walk("moving-goal-untold", "untold [rad/s]", "a moving goal of which nothing is told"),
)


class Reach(NamedTuple):
    """How far a law goes: the level at which it gives way, None if at none, and which step of how many that is.

    fails: it has nothing to lose, and no level.
    """

    level: float | None
    step: int
    steps: int
    fails: bool = False


def reach(rows: pd.DataFrame, law: str, walk: Walk) -> Reach:
    """Of one law along one way.

    Args:
        rows: of `rows.along`.
    """
    start = nominal(tasks.axis(walk.axis))
    there = [x for x in levels(rows) if (x > start if walk.outwards else x < start)]
    path = there if walk.outwards else there[::-1]
    share, time = _at(of(rows, law, start))
    if share < 0.5:
        return Reach(None, 0, len(path), fails=True)
    for step, level in enumerate(path):
        good, slower = _at(of(rows, law, level))
        if good < share - LOST or (walk.axis not in TIMELESS and slower > SLOWED * time):
            return Reach(level, step, len(path))
    return Reach(None, len(path), len(path))


def _at(rows: pd.DataFrame) -> tuple[float, float]:
    return float(rows["good"].mean()), median(rows["time_s"])


def is_fine(one: Reach) -> bool:
    """Whether a law gives way nowhere on its way."""
    return one.level is None and not one.fails


@functools.cache
def reaches(run: Run) -> dict[str, list[Reach]]:
    """law -> how far it goes along each way; laws family by family."""
    found: dict[str, list[Reach]] = {}
    for walk in WALKS:
        rows = along(run, walk.axis)
        for law in laws(rows):
            found.setdefault(law, []).append(reach(rows, law, walk))
    return found
