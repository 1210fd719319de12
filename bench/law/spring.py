"""A spring of a pose: force and moment as functions of the displacement from the goal, and their potential."""

from collections.abc import Callable
from typing import NamedTuple

from bench.law.scalar import atan2, kernel, sqrt
from bench.law.so3 import cross, dot


class Spring(NamedTuple):
    """wrench(q, p, K, Kr) -> (f, m): force [N] and moment [N m] on the hand about its origin, in the hand's axes.

    q, p: X = T_d^-1 T, the pose of the hand seen from the goal: the unit quaternion (w, x, y, z), w >= 0, and the place
    of its origin [m] in the goal's axes. K: the stiffness of position, symmetric, by rows [N/m]. Kr: the stiffness of
    orientation [N m/rad], the same number about every axis. potential(q, p, K, Kr) -> [J]; None if there is none for
    every K. formula: of force and moment, in TeX.

    is_rotational: the spring ignores p and K, its force is zero, and its Kr is a symmetric matrix by rows, for any of
    which its potential holds. frames: the axes in which its moment may be taken, "tool" or "goal"; base axes are the
    goal's, turned by a constant. stiffness: the share of Kr that is felt at the goal.
    """

    name: str
    title: str
    source: str
    formula: str
    wrench: Callable
    potential: Callable | None = None
    is_rotational: bool = False
    frames: tuple[str, ...] = ("tool",)
    stiffness: float = 1.0


@kernel
def times(K, v):
    """Compute K v of a matrix by rows."""
    return (
        K[0][0] * v[0] + K[0][1] * v[1] + K[0][2] * v[2],
        K[1][0] * v[0] + K[1][1] * v[1] + K[1][2] * v[2],
        K[2][0] * v[0] + K[2][1] * v[1] + K[2][2] * v[2],
    )


@kernel
def rotation_vector(q):
    """Compute theta k of a unit quaternion with w >= 0 [rad]."""
    length = sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
    s = 2.0 * atan2(length, q[0]) / length if length > 0.0 else 2.0
    return (s * q[1], s * q[2], s * q[3])


@kernel
def divide_by_left_jacobian(q, phi, v):
    """Compute (I - [phi]x/2 + b [phi]x^2) v, b = (1 - (theta/2) cot(theta/2))/theta^2, phi the rotation vector of q.

    b is its series below 0.01 rad, whose next term, theta^4/30240, is then under 4e-13.
    """
    squared = dot(phi, phi)
    b = 1.0 / 12.0 + squared / 720.0
    if squared > 1e-4:
        length = sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
        b = (1.0 - 0.5 * sqrt(squared) * q[0] / length) / squared
    c = cross(phi, v)
    d = cross(phi, c)
    return (v[0] - 0.5 * c[0] + b * d[0], v[1] - 0.5 * c[1] + b * d[1], v[2] - 0.5 * c[2] + b * d[2])
