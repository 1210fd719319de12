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
from bench.law.inputs import AT_REST, Gains, Goal
from bench.law.so3 import Rotation, from_quaternion

SAMPLED = "uniform"
SAMPLE = 256
"""Uniform orientations; a branch that 1 in 100 of them takes is missed with probability 0.99^256 = 8 %."""

DIRECTED = ("half-turn", "poles", "wraps", "box", "goals", "paper")
SPIN = (0.8, -1.9, 1.3)
"""Any angular velocity with no zero component and no axis of symmetry [rad/s]."""

AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0), "oblique": (0.36, -0.48, 0.8)}
DECADES = range(1, 17)
"""Angles 10^-k rad from the goal; from k = 8 on, cos(angle / 2) is 1 in double precision."""


class State(NamedTuple):
    """What a law is called with, as numpy.float64; `is_sampled` if it counts towards the typical branch."""

    id: str
    R: Rotation
    omega: tuple
    goal: Goal
    is_sampled: bool


GAINS = Gains(*(np.float64(gain) for gain in Gains()))


@functools.cache
def states() -> tuple[State, ...]:
    """All of them, always the same, the sampled ones first."""
    found: list[State] = []
    for start in tasks.start_set(SAMPLED, SAMPLE):
        found += _at_rest_and_spinning(start.id, start.quat_wxyz, start.goal_wxyz, is_sampled=True)
    for name, quat_wxyz in _near_identity():
        found += _at_rest_and_spinning(name, quat_wxyz, (1.0, 0.0, 0.0, 0.0))
    for start_set in DIRECTED:
        for start in tasks.start_set(start_set):
            found += _at_rest_and_spinning(start.id, start.quat_wxyz, start.goal_wxyz)
    return tuple(found)


def _near_identity() -> Iterator[tuple[str, tuple[float, ...]]]:
    yield "identity", (1.0, 0.0, 0.0, 0.0)
    for word, axis in AXES.items():
        for k in DECADES:
            half = 0.5 * 10.0**-k
            yield f"identity-{word}-k{k:02d}", (math.cos(half), *(math.sin(half) * part for part in axis))


def _at_rest_and_spinning(
    name: str, quat_wxyz: tuple[float, ...], goal_wxyz: tuple[float, ...], is_sampled: bool = False
) -> list[State]:
    R, goal = _rotation(quat_wxyz), goal_of(goal_wxyz)
    return [
        State(f"{name} at rest", R, goal.omega, goal, is_sampled),
        State(f"{name} spinning", R, _doubles(SPIN), goal, is_sampled),
    ]


def goal_of(quat_wxyz: tuple[float, ...]) -> Goal:
    """Return a goal that stands still."""
    at_rest = _doubles(AT_REST)
    return Goal(_rotation(quat_wxyz), at_rest, at_rest)


def _rotation(quat_wxyz: tuple[float, ...]) -> Rotation:
    return Rotation(*(_doubles(column) for column in from_quaternion(quat_wxyz)))


def _doubles(vector: tuple) -> tuple:
    return tuple(np.float64(x) for x in vector)
