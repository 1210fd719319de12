"""The record of a controller as it is shipped, which each file of bench/law/contenders/shipped holds, and its law.

The orientation error is a kernel of the unit quaternion (w, x, y, z) of the rotation from R to R_d in the base frame,
of either sign, as its source has it; an error that takes matrices is the same for both signs. `regulator_of` makes a
law of it, u = K e - D omega, which carries the quaternion on from tick to tick as an encoder or an integrator does:
with the memory ANTIPODE an episode begins on the other sign.
"""

import functools
import math
from collections.abc import Callable
from typing import NamedTuple

from bench.law.contender import Regulator
from bench.law.scalar import atan2, kernel, sqrt
from bench.law.so3 import dot, quaternion_direction, spring_damper, turn_matrix

NEAR, ANTIPODE = (1.0, 0.0, 0.0, 0.0), (-1.0, 0.0, 0.0, 0.0)
"""Memories from which an episode begins on the sheet with w >= 0, and on the other one."""

TORQUE, VELOCITY, POSITION = "torque", "velocity", "position"
"""What is commanded: joint torques; velocities; positions, from a plant that the controller simulates."""


class Shipped(NamedTuple):
    """A controller as its authors set it.

    source: repository@commit, or release; path: the files there that were read. level: TORQUE, VELOCITY or POSITION.
    formula: of the error e, with clips and deadbands in their order. error: kernel of the quaternion, see above.
    stiffness: what multiplies e: N m/rad, 1/s^2 where an inertia is cancelled or simulated, 1/s of a velocity;
    damping: what multiplies the angular velocity; None of a velocity. set_by: where they are set.
    shapes_inertia: whether the body that K and D act on is one of unit inertia whatever the robot's.
    unbounded, bound: the error before its bound, and the bound of its components or of its length, if it has one.
    thread: owner/name#number of a public thread on what its error does.
    """

    name: str
    title: str
    source: str
    path: str
    level: str
    formula: str
    error: Callable
    stiffness: float
    damping: float | None
    set_by: str
    shapes_inertia: bool = False
    unbounded: Callable | None = None
    bound: float = math.inf
    thread: str = ""


@kernel
def shorter(q):
    """The quaternion of the same turn whose scalar is not negative; q itself where that is 0."""
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
    v = vector_part(q)
    square = dot(v, v)
    scale = 2.0
    if square > 0.0:
        size = sqrt(square)
        scale = 2.0 * atan2(size, shorter(q)[0]) / size
    return (scale * v[0], scale * v[1], scale * v[2])


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
    """The vector, at most so long: the direction stays."""
    square = dot(e, e)
    if square > limit * limit:
        scale = limit / sqrt(square)
        return (scale * e[0], scale * e[1], scale * e[2])
    return e


@functools.cache
def regulator_of(one: Shipped) -> Regulator:
    """The controller as a law u = kp e - kv omega with its quaternion in memory; once, so that it is compiled once."""
    error = one.error

    @kernel
    def law(R, omega, goal, gains, memory):
        (w, x, y, z), t = quaternion_direction(turn_matrix(R, goal.R))
        scale = 0.5 / sqrt(t)
        if w * memory[0] + x * memory[1] + y * memory[2] + z * memory[3] < 0.0:
            scale = -scale
        q = (scale * w, scale * x, scale * y, scale * z)
        return spring_damper(gains.kp, error(q), gains.kv, omega), q

    return Regulator(one.name, one.title, one.source, one.formula, law=law, memory=NEAR, property="none")
