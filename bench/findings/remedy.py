"""The smallest fix of a shipped controller's orientation error, and its greatest command before and after.

A bound is not a fault: a fix keeps it, and at most bounds the
length where each component is clipped. An error that is replaced keeps the greatest command that it had.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from bench.law.contenders.registry import contenders
from bench.law.shipped import VELOCITY, AsShipped, logarithm
from tasks.haar import axes

KEEP = "Keep it."
NEAR_RAD, BEYOND_RAD = 0.05, math.radians(120.0)
DIRECTIONS = np.concatenate((np.eye(3), axes(60)))
HALF = (0.45, 0.55)
"""Slope of an error near the goal that lacks a factor of 2."""
BENT_RAD = 1e-6
SMALL, SMALLEST = 1e-9, math.ulp(0.0)


class Fix(NamedTuple):
    """What to change, KEEP if nothing; the greatest K e about an axis of the base before and after, 0 of a speed."""

    words: str
    before: float
    after: float


def smallest_fix(one: AsShipped) -> Fix:
    """Return the smallest fix of a controller's error, by what its error does."""
    free, steps, factor = one.unbounded or one.error, [], 1.0
    fixed, bound = free, one.bound
    if not any(free(about(DIRECTIONS[-1], math.pi))):
        if largest(with_sign(free), math.pi) > SMALL:
            steps.append("take the sign of zero as 1 (`copysign(1, w)`)")
            fixed = with_sign(free)
        else:
            bound = largest(free, None)
            steps.append(
                "for goals more than 90° away, return axis times angle, clipped to a length of "
                f"at most {bound:.3g}"
            )
            fixed = logarithm
    if HALF[0] < np.dot(free(about(DIRECTIONS[0], NEAR_RAD)), DIRECTIONS[0]) / NEAR_RAD < HALF[1]:
        steps.append("multiply the vector part by 2" + (", before the clip" if math.isfinite(one.bound) else ""))
        factor = 2.0
    if is_bent(one.error):
        steps.append(f"to keep the direction, clip the vector's length at {bound:g}, not each component")
    words = f"{'; '.join(steps)}."
    before = 0.0 if one.level == VELOCITY else one.gains.kp * largest(one.error, None)
    if not steps:
        return Fix(KEEP, before, before)
    return Fix(words[0].upper() + words[1:], before, one.gains.kp * min(bound, factor * largest(fixed, None)))


def fix_of(name: str) -> Fix:
    """Return the smallest fix of the controller of this name."""
    return smallest_fix(contenders("shipped")[name])


def about(k: np.ndarray, angle: float) -> tuple[float, ...]:
    """Return the quaternion of a rotation; its scalar is exactly 0 at 180°."""
    w = 0.0 if angle == math.pi else math.cos(0.5 * angle)
    return (w, *(math.sin(0.5 * angle) * k).tolist())


def largest(error: Callable, angle: float | None) -> float:
    """Return the greatest component of the error about the axes of the base, at an angle or, for None, at any."""
    angles = (*np.linspace(0.0, math.pi, 181), math.pi - SMALL) if angle is None else (angle,)
    return max(max(map(abs, error(about(k, float(one))))) for one in angles for k in DIRECTIONS)


def is_bent(error: Callable) -> bool:
    """Return whether the error leaves the axis far from the goal, as a clip of each component makes it."""
    e = [np.array(error(about(k, BEYOND_RAD))) for k in DIRECTIONS]
    return any(np.linalg.norm(np.cross(one, k)) > BENT_RAD for one, k in zip(e, DIRECTIONS, strict=True))


def with_sign(error: Callable) -> Callable:
    """Return the error with the sign of zero taken as 1."""
    return lambda q: error((q[0] or SMALLEST, *q[1:]))
