"""A spring of position and orientation: a wrench as a function of the pose that is left, and its potential."""

from collections.abc import Callable
from typing import NamedTuple

from bench.law.scalar import atan2, kernel, sqrt


class PoseSpring(NamedTuple):
    """wrench(q, p, K, kr) -> (f, m): force [N] and moment [N m] on the hand about its origin, in its own axes.

    q, p: X = T_d^-1 T, the pose of the hand seen from the goal: the unit quaternion (w, x, y, z), w >= 0, and the place
    of its origin [m] in the goal's axes. K: the stiffness of position, symmetric, by rows [N/m]; kr: that of
    orientation [N m/rad], the same about every axis. potential(q, p, K, kr) -> [J]; None if there is none for every K.
    formula: of force and moment, in TeX.
    """

    name: str
    title: str
    source: str
    formula: str
    wrench: Callable
    potential: Callable | None = None


@kernel
def rotation_vector(q):
    """theta k of a unit quaternion with w >= 0 [rad]."""
    length = sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
    s = 2.0 * atan2(length, q[0]) / length if length > 0.0 else 2.0
    return (s * q[1], s * q[2], s * q[3])
