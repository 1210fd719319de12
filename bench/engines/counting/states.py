"""The states a law is counted at: sampled ones for the typical branch, directed ones for the rare branches.

Each start is taken at rest and spinning. 180° rotations, poles, wraps and far goals are the judge's start sets;
states at and near the goal, where an episode would have nothing to regulate, are ours.
"""

import functools
import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

import tasks
from bench.law.inputs import AT_REST, PAPERS_GAINS, Goal, Tuning
from bench.law.so3 import Rotation, from_quaternion
from tasks.base import IDENTITY, Start

SAMPLED = "uniform"
SAMPLE = 256
"""Uniform orientations; a branch that 1 in 100 of them takes is missed with probability 0.99^256 = 8 %."""

DIRECTED = ("half-turn", "poles", "wraps", "box", "goals", "paper")
SPIN = (0.8, -1.9, 1.3)
"""Any angular velocity with no zero component and no axis of symmetry [rad/s]."""

AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0), "oblique": (0.36, -0.48, 0.8)}
DECADES = range(1, 17)
"""Angles 10^-k rad from the goal; from k = 8 on, cos(angle / 2) is 1 in double precision."""


class CountedState(NamedTuple):
    """What a law is called with, as numpy.float64; `is_sampled` if it counts towards the typical branch."""

    id: str
    R: Rotation
    omega: tuple
    goal: Goal
    is_sampled: bool


BOUND_OVER_KP = 0.1
"""A bound that a law meets far from the goal and not near it, so that both its branches are counted."""

LIMITED = Tuning(*PAPERS_GAINS, bound=BOUND_OVER_KP * PAPERS_GAINS.kp)
GAINS = Tuning(*(np.float64(number) for number in LIMITED))


@functools.cache
def states() -> tuple[CountedState, ...]:
    """All of them, always the same, the sampled ones first."""
    starts = [(start, True) for start in tasks.start_set(SAMPLED, SAMPLE)]
    starts += [(start, False) for start in _near_identity()]
    starts += [(start, False) for name in DIRECTED for start in tasks.start_set(name)]
    paces = {"at rest": _doubles(AT_REST), "spinning": _doubles(SPIN)}
    return tuple(
        CountedState(
            f"{start.id} {word}",
            _rotation(start.quat_wxyz),
            omega,
            goal_of(start.goal_wxyz),
            is_sampled,
        )
        for start, is_sampled in starts
        for word, omega in paces.items()
    )


def _near_identity() -> Iterator[Start]:
    yield Start("identity", IDENTITY)
    for word, axis in AXES.items():
        for k in DECADES:
            half = 0.5 * 10.0**-k
            x, y, z = (math.sin(half) * part for part in axis)
            yield Start(f"identity-{word}-k{k:02d}", (math.cos(half), x, y, z))


def goal_of(quat_wxyz: tuple[float, ...]) -> Goal:
    """Return a goal that stands still."""
    at_rest = _doubles(AT_REST)
    return Goal(_rotation(quat_wxyz), at_rest, at_rest)


def _rotation(quat_wxyz: tuple[float, ...]) -> Rotation:
    return Rotation(*(_doubles(column) for column in from_quaternion(quat_wxyz)))


def _doubles(vector: tuple) -> tuple:
    return tuple(np.float64(x) for x in vector)
