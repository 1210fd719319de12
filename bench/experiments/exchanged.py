"""Which components of a quaternion a law has exchanged, known by its commands at rest.

A law that takes (x, y, z, w) for (w, x, y, z) commands what a sound law commands for the quaternion of these
components. Each order of the four, of the error or of both quaternions that it is made of, is tried with each usual
error; one of them has to explain every command.
"""

import itertools
from collections.abc import Callable, Iterator, Sequence

import numpy as np

from bench.experiments.field import CommandField, about
from tasks.haar import axes

TURNS, SAME = 60, 1e-6
"""Rotations that are tried. Share of the greatest command by which one may differ: rounding leaves 1e-12, and two
orders, or two errors, differ by more than a tenth."""

RIGHT = "wxyz"
WRONG = [places for places in itertools.permutations(range(4)) if places != (0, 1, 2, 3)]
CONJUGATE = np.array((1.0, -1.0, -1.0, -1.0))

FORMS: tuple[Callable[[np.ndarray], np.ndarray], ...] = (
    lambda p: 2.0 * p[:, 1:] * np.where(p[:, :1] < 0.0, -1.0, 1.0),
    lambda p: 2.0 * p[:, 1:],
    lambda p: 2.0 * p[:, 1:] * p[:, :1],
    lambda p: 4.0 * p[:, 1:] / (1.0 + np.abs(p[:, :1])) * np.where(p[:, :1] < 0.0, -1.0, 1.0),
    lambda p: p[:, 1:] * _angle_over_sine(p),
)
"""Errors by a unit quaternion p, w x y z: the vector part of its shorter or its given side, the sine of the angle,
modified Rodrigues parameters, and the rotation vector."""


def find_order(field: CommandField) -> str:
    """Return the components that a law takes for w x y z, as "xyzw"; empty if no order explains its commands."""
    turns = _spread_turns()
    commands = field(turns * CONJUGATE)  # R from which the rotation to the goal I is `turns`
    if not np.isfinite(commands).all():
        return ""
    for order, read in _orders(turns):
        if any(_explains(form(read), commands) for form in FORMS):
            return order
    return ""


def _spread_turns() -> np.ndarray:
    """Return rotations of 10 to 170 degrees, away from each change of sign; w x y z with w above 0."""
    angles = np.radians(np.linspace(10.0, 170.0, TURNS))
    return about(axes(TURNS), angles)


def _orders(turns: np.ndarray) -> Iterator[tuple[str, np.ndarray]]:
    """Yield each wrong order and the error as it is read: exchanged itself, then made of two that are."""
    for places in WRONG:
        yield _name(places), turns[:, places]
    for places in WRONG:
        goal = np.broadcast_to(np.eye(4)[0][list(places)], turns.shape)
        now_conjugate = (turns * CONJUGATE)[:, places] * CONJUGATE
        yield _name(places), _product(goal, now_conjugate)
        yield _name(places), _product(now_conjugate, goal)


def _name(places: Sequence[int]) -> str:
    return "".join(RIGHT[place] for place in places)


def _explains(error: np.ndarray, commands: np.ndarray) -> bool:
    """Tell whether commands are one number times an error."""
    with np.errstate(all="ignore"):
        share = np.sum(error * commands) / np.sum(error * error)
        return bool(np.abs(commands - share * error).max() < SAME * np.abs(commands).max())


def _angle_over_sine(p: np.ndarray) -> np.ndarray:
    """Return theta / sin(theta/2), with the sign of w."""
    length = np.linalg.norm(p[:, 1:], axis=1, keepdims=True)
    angle = 2.0 * np.arctan2(length, np.abs(p[:, :1]))
    return angle / length * np.where(p[:, :1] < 0.0, -1.0, 1.0)


def _product(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Return p q of quaternions w x y z."""
    w = p[:, :1] * q[:, :1] - np.sum(p[:, 1:] * q[:, 1:], axis=1, keepdims=True)
    v = p[:, :1] * q[:, 1:] + q[:, :1] * p[:, 1:] + np.cross(p[:, 1:], q[:, 1:])
    return np.concatenate((w, v), axis=1)
