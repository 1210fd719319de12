"""A situation of the free body in dimensionless numbers: gains, motors, timing, inertia, spin and jumps of the goal.

Time is counted in 1/sqrt(kp), commands in kp: at equal numbers every kp gives the same motion on another clock.
"""

from __future__ import annotations

import math
import zlib
from collections import namedtuple
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np

from tasks.base import AT_REST, IDENTITY, Start
from tasks.condition import Condition

KP = 100.0
"""At which situations are simulated [1/s^2]: the paper's."""


class Coordinate(NamedTuple):
    """One number of a situation: what it is, its value where nothing is said, and the values at which laws are run.

    text: how its value is written, with the number in braces. is_ratio: whether half and twice are equally far away.
    weight: how much it counts where the nearest of some situations is sought; of a few weights those were taken with
    which, of situations left out one by one, the nearest other one gave the best advice.
    """

    title: str
    text: str
    nominal: float
    levels: tuple[float, ...]
    is_ratio: bool = False
    weight: float = 1.0

    def scale(self, value: float) -> float:
        """Return a value's place between the extreme levels, 0 to 1; a bound that is infinite lies above the others."""
        finite = [self._place(level) for level in self.levels if math.isfinite(level)]
        low, high = min(finite), max(finite)
        place = self._place(value) if math.isfinite(value) else high + 0.25 * (high - low)
        return (min(max(place, low), high + 0.25 * (high - low)) - low) / (high - low)

    def _place(self, value: float) -> float:
        return math.log(value) if self.is_ratio else value


COORDINATES = {
    "zeta": Coordinate(
        "damping ratio kv/(2 √kp)", "{:g}", 1.0, (0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.2, 1.5, 2.0), True, 3.0
    ),
    "bound": Coordinate(
        "bound of the command over kp [rad]",
        "{:g} kp",
        math.inf,
        (0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0, 1.2, 1.5, 2.0, 3.0, math.inf),
        True,
        3.0,
    ),
    "delay": Coordinate("delay times √kp", "{:g}/√kp", 0.0, (0.0, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3)),
    "period": Coordinate("control period times √kp", "{:g}/√kp", 0.01, (0.01, 0.05, 0.1, 0.2, 0.3, 0.5)),
    "inertia": Coordinate("inertia over its model", "{:g}", 1.0, (0.4, 0.5, 0.7, 1.0, 1.4, 2.0, 3.0, 4.0), True, 2.0),
    "unevenness": Coordinate(
        "principal moments 1 - s, 1 and 1 + s", "{:g}", 0.0, (0.0, 0.1, 0.2, 0.3, 0.4, 0.5), weight=0.5
    ),
    "spin": Coordinate("speed at the start over √kp", "{:g} √kp", 0.0, (0.0, 0.5, 1.0, 1.5, 2.0, 3.0), weight=0.5),
    "jump": Coordinate(
        "time at which the goal jumps, times √kp", "{:g}/√kp", 0.0, (0.0, 0.5, 1.0, 2.0, 5.0), weight=0.5
    ),
}
"""The numbers of a situation, in order."""

_record: Any = namedtuple  # which a type checker cannot follow
_VALUES: Any = _record("_VALUES", COORDINATES, defaults=[one.nominal for one in COORDINATES.values()])


class Situation(_VALUES):
    """A value of each of COORDINATES."""

    __slots__ = ()

    @property
    def word(self) -> str:
        """Return the situation as one word; `read_situation` takes it."""
        return "_".join(f"{value:g}" for value in self)

    @property
    def kv(self) -> float:
        """Velocity gain at KP [1/s]."""
        return 2.0 * self.zeta * math.sqrt(KP)

    def condition(self, worst_attitude_error: float = 0.0) -> Condition:
        """Return the condition of an episode at KP; worst_attitude_error: an adversary's at 180° [rad]."""
        unit_s = 1.0 / math.sqrt(KP)
        uneven = (1.0 - self.unevenness, 1.0, 1.0 + self.unevenness)
        return Condition(
            bound=self.bound * KP,
            delay_s=self.delay * unit_s,
            period_s=self.period * unit_s,
            inertia=tuple(self.inertia * one for one in uneven),
            jump_s=self.jump * unit_s,
            worst_attitude_error=worst_attitude_error,
        )

    def starts(self, count: int, seed: int) -> list[Start]:
        """Draw starts independently of each other: the first `count` of the situation's sequence.

        Orientations have the Haar measure; spins have the situation's speed and uniform directions; a goal that the
        situation lets jump is a second draw of the Haar measure. Each situation has a sequence of its own, the same
        for every law: statistics over starts (order statistics, Wilks' bound, the paired bootstrap) need independent
        draws, and shares over drawn situations need situations whose starts are independent as well.
        """
        digest = zlib.crc32(self.word.encode())
        # A generator each, filled row by row: so that the first rows do not depend on how many are drawn.
        of_start, of_spin, of_goal = (np.random.default_rng((seed, digest, part)) for part in range(3))
        orientations = _draw_unit_vectors(of_start, count, 4)
        spins = [AT_REST] * count
        if self.spin:
            speed = self.spin * math.sqrt(KP)
            spins = list(map(tuple, (speed * _draw_unit_vectors(of_spin, count, 3)).tolist()))
        goals = [IDENTITY] * count
        if self.jump:
            goals = list(map(tuple, _draw_unit_vectors(of_goal, count, 4).tolist()))
        return [
            Start(f"drawn-{number:05d}", tuple(quat_wxyz), spin, goal)
            for number, (quat_wxyz, spin, goal) in enumerate(zip(orientations.tolist(), spins, goals, strict=True))
        ]

    def scaled(self) -> tuple[float, ...]:
        """Return the place of every number between its extreme levels, times its weight."""
        return tuple(one.weight * one.scale(value) for one, value in zip(COORDINATES.values(), self, strict=True))

    def describe(self) -> str:
        """Say in which numbers it differs from the nominal situation, the damping ratio always."""
        parts = [
            f"{name} {one.text.format(value)}"
            for (name, one), value in zip(COORDINATES.items(), self, strict=True)
            if name == "zeta" or value != one.nominal
        ]
        return ", ".join(parts)


def _draw_unit_vectors(rng: np.random.Generator, count: int, dimensions: int) -> np.ndarray:
    """Draw points of the unit sphere, uniform and independent, shape (count, dimensions).

    Four dimensions are unit quaternions, and a uniform one is a rotation of the Haar measure.
    """
    drawn = rng.standard_normal((count, dimensions))
    return drawn / np.linalg.norm(drawn, axis=1, keepdims=True)


NOMINAL = Situation()
UNCANCELLED = NOMINAL._replace(unevenness=0.3)
"""Holds where no model cancels the inertia and nothing else is known: principal moments of 0.7, 1 and 1.3."""


def read_situation(word: str) -> Situation:
    """Return the situation of a word."""
    return Situation(*map(float, word.split("_")))


def rounded(values: Iterable[float]) -> Situation:
    """Return a situation with numbers of three digits."""
    return Situation(*(float(f"{value:.3g}") for value in values))
