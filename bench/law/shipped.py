"""A controller as it is shipped, as a law: what each file of bench/law/contenders/shipped declares.

The orientation error is a kernel of the unit quaternion (w, x, y, z) of the rotation from R to R_d in the base frame,
of either sign, as its source has it; an error that takes matrices is the same for both signs. `law_of` makes a
law of it, u = K e - D omega, which carries the quaternion on from tick to tick as an encoder or an integrator does:
with the memory ANTIPODE an episode begins on the other sign.
"""

import math
import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from bench.law.attribution import PUBLISHED
from bench.law.inputs import Gains
from bench.law.kinds import HasLaw, Law
from bench.law.scalar import kernel, sqrt
from bench.law.so3 import dot, quaternion_direction, spring_damper, turn_matrix
from bench.law.spring import rotation_vector

NEAR, ANTIPODE = (1.0, 0.0, 0.0, 0.0), (-1.0, 0.0, 0.0, 0.0)
"""Memories from which an episode begins on the sheet with w >= 0, and on the other one."""


TORQUE, VELOCITY, POSITION = "torque", "velocity", "position"
"""Levels: what a controller commands. Of a position, it simulates the plant that moves there."""


@dataclass(frozen=True)
class AsShipped(HasLaw):
    """A controller as its authors set it, in words and numbers of its source.

    The formula of its law is that of its error, with clips and deadbands in the order in which the controller applies
    them.

    Attributes:
        law: The law of the error, which `law_of` makes.
        gains: The gains that its authors set. The unit of the stiffness is N m/rad. It is 1/s^2 if
            the controller cancels or simulates an inertia, and 1/s if it commands a velocity.
        level: The kind of command: "torque", "velocity" or "position".
        error: Kernel of the quaternion.
        path: The files of the law's source, repository@commit or release, that were read.
        set_by: Where the gains are set.
        shapes_inertia: Whether the body that the gains act on is one of unit inertia whatever the robot's.
        unbounded: The error before its bound, if it has one.
        bound: The bound of the error's components or of its length, if it has one.
        thread: owner/name#number of a public thread on what its error does.
    """

    gains: Gains
    level: str
    error: Callable
    path: str
    set_by: str
    shapes_inertia: bool = False
    unbounded: Callable | None = None
    bound: float = math.inf
    thread: str = ""


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
def vector_part_by_sign(q):
    """sign(w) sin(theta/2) k of either rotation, where sign(0) = 0."""
    if q[0] > 0.0:
        return (q[1], q[2], q[3])
    if q[0] < 0.0:
        return (-q[1], -q[2], -q[3])
    return (0.0 * q[1], 0.0 * q[2], 0.0 * q[3])


@kernel
def sine(q):
    """sin(theta) k, of either sign of q."""
    return (2.0 * q[0] * q[1], 2.0 * q[0] * q[2], 2.0 * q[0] * q[3])


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


@kernel
def scaled(e, factor):
    """Return the vector times a factor."""
    return (factor * e[0], factor * e[1], factor * e[2])


@kernel
def beyond(x, limit):
    """x, or 0 within the limit."""
    if -limit < x < limit:
        return 0.0 * x
    return x


@kernel
def without_small(e, limit):
    """Each component, or 0 within the limit."""
    return (beyond(e[0], limit), beyond(e[1], limit), beyond(e[2], limit))


ERRORS = {
    "logarithm": logarithm,
    "vector-part": vector_part,
    "vector-part-by-sign": vector_part_by_sign,
    "sine": sine,
}
BOUNDS = {"clip": clipped, "shorten": shortened}
CHANGES = BOUNDS | {"scale": scaled, "deadband": without_small}
"""The errors that a TOML file may name, and what may be done to one, by a number."""


def changed(error: Callable, change: Callable, number: float) -> Callable:
    """Return an error after one of CHANGES."""

    @kernel
    def changed_error(q):
        return change(error(q), number)

    return changed_error


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


LAWS_WORDS = ("title", "source", "formula")
"""Words of a TOML file that are fields of the law; the others are fields of `AsShipped`."""


def read_shipped(path: Path) -> AsShipped:
    """Return the controller that a TOML file declares: an error, one of CHANGES to it, gains, and words.

    stiffness: over the `inertia` that the source simulates, if it does. damping, or the damping_ratio with which 2√K
    makes it.
    """
    words = tomllib.loads(path.read_text(encoding="utf-8"))
    free = error = ERRORS[words.pop("error")]
    for word in CHANGES.keys() & words:
        number = words.pop(word)
        error = changed(free, CHANGES[word], number)
        words |= {"unbounded": free, "bound": number} if word in BOUNDS else {}
    stiffness = words.pop("stiffness") / words.pop("inertia", 1.0)
    damping = words.pop("damping", None)
    if damping is None:
        damping = 2.0 * words.pop("damping_ratio") * stiffness**0.5
    law = Law(
        name=path.stem.replace("_", "-"),
        **{word: words.pop(word) for word in LAWS_WORDS},
        law=law_of(error),
        memory=NEAR,
        property="none",
        attribution=PUBLISHED,
    )
    return AsShipped(law, Gains(stiffness, damping), error=error, **words)
