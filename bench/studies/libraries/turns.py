"""The turns at which libraries are asked: their axis, angle, quaternion and matrix computed with 60 digits.

A library is given the nearest doubles, so that what it should say is known to a unit in the last place. Exact 180°
rotations have w = 0 and an exactly symmetric matrix. Near 180° the distance from it is given, not the
angle: sin(distance/2) = w keeps all its digits.
"""

import itertools
from collections.abc import Sequence
from typing import Any, NamedTuple

import mpmath
import numpy as np

from bench.law.so3 import from_quaternion

DIGITS = mpmath.mp.clone()
DIGITS.dps = 60

DRAWN_AXES = 74
DRAWN_TURNS = 500
NEAREST_DECADE = 15
SMALLEST_DECADE = 12


class Turn(NamedTuple):
    """A turn by `angle` [rad], at most pi, about the unit vector `axis`: R (3 x 3) and quat_wxyz of it, w >= 0."""

    axis: np.ndarray
    angle: float
    quat_wxyz: np.ndarray
    R: np.ndarray


class TurnSet(NamedTuple):
    """Turns of one family; angle_rad or distance_rad (from 180°) where they have it in common, else None."""

    name: str
    turns: tuple[Turn, ...]
    angle_rad: float | None = None
    distance_rad: float | None = None


def of_quaternion(w: Any, x: Any, y: Any, z: Any) -> Turn:
    """Return the turn of a quaternion of any length, exact or of 60 digits; w must not be negative."""
    length = DIGITS.sqrt(w * w + x * x + y * y + z * z)
    w, x, y, z = (DIGITS.mpf(part) / length for part in (w, x, y, z))
    sine = DIGITS.sqrt(x * x + y * y + z * z)
    return Turn(
        axis=np.array([float(part / sine) for part in (x, y, z)]),
        angle=float(2 * DIGITS.atan2(sine, w)),
        quat_wxyz=np.array([float(part) for part in (w, x, y, z)]),
        R=np.array([*zip(*from_quaternion((w, x, y, z)), strict=True)], dtype=float),
    )


def about(axis: Sequence[Any], half_cosine: Any, half_sine: Any) -> Turn:
    """Return the turn with these functions of half its angle, about an axis of any length."""
    length = DIGITS.sqrt(sum(part * part for part in axis))
    return of_quaternion(half_cosine, *(half_sine * part / length for part in axis))


def axes() -> list[tuple[int, int, int]]:
    """Return the 26 to the faces, edges and corners of a cube, in exact integers, and some drawn."""
    cube = filter(any, itertools.product((-1, 0, 1), repeat=3))
    drawn = np.random.default_rng(1).normal(scale=1000.0, size=(DRAWN_AXES, 3)).astype(int).tolist()
    return [(x, y, z) for x, y, z in (*cube, *drawn)]


def small(decade: int) -> TurnSet:
    """Return rotations by 10^-decade rad."""
    half = DIGITS.mpf(10) ** -decade / 2
    turns = tuple(about(axis, DIGITS.cos(half), DIGITS.sin(half)) for axis in axes())
    return TurnSet(f"angle-1e-{decade:02d}", turns, angle_rad=10.0**-decade)


def near_half_turn(decade: int, times: int = 1) -> TurnSet:
    """Return rotations by 180° less times 10^-decade rad."""
    distance = times * DIGITS.mpf(10) ** -decade
    turns = tuple(about(axis, DIGITS.sin(distance / 2), DIGITS.cos(distance / 2)) for axis in axes())
    return TurnSet(f"half-turn-{times}e-{decade:02d}", turns, distance_rad=float(distance))


def half_turns() -> TurnSet:
    """Return exact 180° rotations."""
    return TurnSet("half-turn", tuple(about(axis, 0, 1) for axis in axes()), distance_rad=0.0)


def drawn() -> TurnSet:
    """Draw uniform quaternions, rounded to integers."""
    found = np.random.default_rng(2).normal(scale=1e6, size=(DRAWN_TURNS, 4)).astype(int).tolist()
    return TurnSet("drawn", tuple(of_quaternion(abs(w), x, y, z) for w, x, y, z in found))


def poles() -> TurnSet:
    """Z-Y-X at beta = pi/2 (y = w, x = -z) and -pi/2 (y = -w, x = z): no 180° rotations."""
    pairs = [(1, 0), (1, 1), (2, 1), (3, -1), (1, -2), (7, 4), (5, -12), (4, 3)]
    turns = [of_quaternion(w, -side * z, side * w, z) for w, z in pairs for side in (1, -1)]
    return TurnSet("pole", tuple(turns))


def every_set() -> tuple[TurnSet, ...]:
    """Return all sets, from the smallest rotations to 180°."""
    return (
        *(small(decade) for decade in range(SMALLEST_DECADE, 0, -1)),
        drawn(),
        poles(),
        *(near_half_turn(decade, times) for decade in range(1, NEAREST_DECADE + 1) for times in (5, 2, 1)),
        half_turns(),
    )
