"""The part of a plan that is in trouble: which laws meet which axes (tasks/conditions), a unit a law and axis."""

from __future__ import annotations

from dataclasses import dataclass

import tasks
from bench.contenders.registry import papers_laws
from bench.errors import Incompatible
from bench.experiments.choice import Choice
from bench.experiments.suites import Robustness
from bench.law.contender import Contender

HORIZON_S = 5.0
"""Longest simulated time [s]: eight settling times of a small error, and a tail to average over."""


@dataclass(frozen=True)
class RobustnessUnit:
    """A piece of work that is done or not done: one law along one axis, so many starts at every level."""

    contender: str
    axis: str
    starts: int
    count: int
    horizon_s: float

    table = "robustness"

    @property
    def key(self) -> str:
        """A name for a file."""
        return f"robustness_{self.contender.replace('/', '~')}_{self.axis}"

    @property
    def label(self) -> str:
        """What is done to which law, in a few words."""
        return f"{self.axis} {self.contender.split('/')[0]}"


def units(
    part: Robustness, laws: list[Contender], choice: Choice, starts: int | None, horizon_s: float | None
) -> tuple[RobustnessUnit, ...]:
    """The units of a suite's part, narrowed or widened by what the user named.

    Args:
        starts: at each level; the suite's number if None.
    Errors:
        Incompatible: axes are named and no law that can meet them.
    """
    if not choice.takes_robustness:
        return ()
    chosen = [one for one in laws if _takes_part(one, part, choice)]
    if choice.axes and not chosen:
        usual = papers_laws()[0].name
        raise Incompatible(f"nothing to run: along an axis go laws of the free body (try: --regulator {usual})")
    axes = [tasks.axis(name) for name in choice.axes or tasks.axis_names()]
    each = starts or part.starts
    return tuple(
        RobustnessUnit(one.name, axis.name, each, each * len(axis.levels), horizon_s or HORIZON_S)
        for one in chosen
        for axis in axes
    )


def _takes_part(one: Contender, part: Robustness, choice: Choice) -> bool:
    """Whether it is a law on R or on the paper's coordinates, a user's, or named; and no actuator of MuJoCo's."""
    is_wanted = bool(one.regulator.origin or choice.regulators or choice.representations)
    is_usual = not one.is_elsewhere or part.others is None or one.name in part.others
    return (is_wanted or is_usual) and not one.regulator.in_engine
