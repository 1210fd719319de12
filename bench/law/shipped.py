"""A controller as it is shipped, which each file of bench/law/contenders/shipped holds, as a law.

The orientation error is a kernel of the unit quaternion (w, x, y, z) of the rotation from R to R_d in the base frame,
of either sign, as its source has it; an error that takes matrices is the same for both signs. `law_of` makes a
law of it, u = K e - D omega, which carries the quaternion on from tick to tick as an encoder or an integrator does:
with the memory ANTIPODE an episode begins on the other sign.
"""

from collections.abc import Callable
from typing import Any

from bench.law.inputs import Gains
from bench.law.kinds import AsShipped, Law
from bench.law.scalar import kernel, sqrt
from bench.law.so3 import dot, quaternion_direction, spring_damper, turn_matrix
from bench.law.spring import rotation_vector

NEAR, ANTIPODE = (1.0, 0.0, 0.0, 0.0), (-1.0, 0.0, 0.0, 0.0)
"""Memories from which an episode begins on the sheet with w >= 0, and on the other one."""


@kernel
def shorter(q):
    """Return the quaternion of the same turn whose scalar is not negative; q itself where that is 0."""
    if q[0] < 0.0:
        return (-q[0], -q[1], -q[2], -q[3])
    return q


@kernel
def vector_part(q):
    """Return sin(theta/2) k of the shorter rotation."""
    s = shorter(q)
    return (s[1], s[2], s[3])


@kernel
def logarithm(q):
    """theta k, theta = 2 atan2(sin(theta/2), cos(theta/2)) in [0, pi]."""
    return rotation_vector(shorter(q))


@kernel
def bounded(x, limit):
    """x held in [-limit, limit]."""
    if x > limit:
        return limit
    if x < -limit:
        return -limit
    return x


@kernel
def clipped(e, limit):
    """Each component held in [-limit, limit]: the direction turns."""
    return (bounded(e[0], limit), bounded(e[1], limit), bounded(e[2], limit))


@kernel
def shortened(e, limit):
    """Return the vector, at most so long: the direction stays."""
    square = dot(e, e)
    if square > limit * limit:
        scale = limit / sqrt(square)
        return (scale * e[0], scale * e[1], scale * e[2])
    return e


def law_of(error: Callable) -> Callable:
    """Return the law u = kp e - kv omega of an error, with its quaternion in memory."""

    @kernel
    def law(R, omega, goal, gains, memory):
        (w, x, y, z), t = quaternion_direction(turn_matrix(R, goal.R))
        scale = 0.5 / sqrt(t)
        if w * memory[0] + x * memory[1] + y * memory[2] + z * memory[3] < 0.0:
            scale = -scale
        q = (scale * w, scale * x, scale * y, scale * z)
        return spring_damper(gains.kp, error(q), gains.kv, omega), q

    return law


def as_shipped(
    name: str,
    title: str,
    source: str,
    path: str,
    level: str,
    formula: str,
    error: Callable,
    stiffness: float,
    damping: float,
    set_by: str,
    **more: Any,
) -> Law:
    """Return the law of a controller as its authors set it; more: other fields of `AsShipped`."""
    return Law(
        name,
        title,
        source,
        formula,
        law_of(error),
        memory=NEAR,
        property="none",
        level=level,
        gains=Gains(stiffness, damping),
        shipped=AsShipped(error, path, set_by, **more),
    )
