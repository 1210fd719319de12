"""Paths of a tool's orientation: along a geodesic, and along a straight line of Z-Y-X angles (Murphy 1988, 2.7).

Limitations: Z-Y-X angles on the pole beta = +-pi/2; a straight line between principal values does not cross +-pi.
"""

from __future__ import annotations

import math

from tasks.base import Quat, Vector
from tasks.rotations import about, columns, multiply, zyx


def geodesic(quat: Quat, axis: Vector, angle: float, steps: int) -> list[Quat]:
    """Return steps + 1 orientations, evenly from `quat` to `quat` turned by `angle` [rad] about a base-frame axis."""
    return [turned(quat, axis, angle * i / steps) for i in range(steps + 1)]


def turned(quat: Quat, axis: Vector, angle: float) -> Quat:
    """`quat` turned by an angle in [-pi, pi] about a base-frame axis, and of unit length."""
    return normal(multiply(about(axis, angle), quat))


def straight_zyx(quat: Quat, goal: Quat, steps: int) -> list[Quat]:
    """Return steps + 1 orientations with evenly spaced Z-Y-X angles, from those of `quat` to those of `goal`."""
    first, last = zyx_angles(quat), zyx_angles(goal)
    return [zyx(*(a + (b - a) * i / steps for a, b in zip(first, last, strict=True))) for i in range(steps + 1)]


def to_vertical(quat: Quat, sign: int, steps: int) -> list[Quat]:
    """Return steps + 1 orientations on the shortest path until the body's x axis n is (0, 0, sign)."""
    n = columns(quat)[0]
    away = math.hypot(n[0], n[1])
    axis = (sign * n[1] / away, -sign * n[0] / away, 0.0) if away > 0.0 else (1.0, 0.0, 0.0)
    return geodesic(quat, axis, math.atan2(away, sign * n[2]), steps)


def beyond(quat: Quat, middle: Quat) -> Quat:
    """Reflect `quat` at `middle`: middle quat^-1 middle, so that `middle` halves the geodesic between the two."""
    w, x, y, z = quat
    return normal(multiply(multiply(middle, (w, -x, -y, -z)), middle))


def zyx_angles(quat: Quat) -> Vector:
    """alpha, beta, gamma [rad] of R = Rz(alpha) Ry(beta) Rx(gamma), |beta| <= pi/2."""
    n, o, a = columns(quat)
    return (math.atan2(n[1], n[0]), math.atan2(-n[2], math.hypot(n[0], n[1])), math.atan2(o[2], a[2]))


def cos_beta(quat: Quat) -> float:
    """|cos beta|: 0 on the pole of the Z-Y-X angles, 1 farthest from it."""
    n = columns(quat)[0]
    return math.hypot(n[0], n[1])


def normal(quat: Quat) -> Quat:
    """quat / |quat|."""
    length = math.hypot(*quat)
    return (quat[0] / length, quat[1] / length, quat[2] / length, quat[3] / length)
