"""Entries of an export: the functions that its files offer, in the base frame and in the body frame.

An entry is a function of the law dialect around the law and is translated with it, so that no language has formulas of
its own. Vectors are in the base frame; what is in the body frame has a name that ends in `_body`, and a quaternion
(w, x, y, z) one that ends in `_wxyz`.
"""

from collections.abc import Callable, Iterable
from typing import NamedTuple

import numpy as np

from bench.law import AT_REST, Gains, Goal, Tuning, kernel
from bench.law.inputs import reads_limits
from bench.law.so3 import cross, dot, from_quaternion, minus, rotate, rotate_back, turn_quaternion
from bench.law.tracking import carried_along


class Parameter(NamedTuple):
    """An argument of an entry: its name, its kind and how many numbers it has.

    kind: "matrix" (a rotation), "rows" (another matrix, by rows), "vector" (in the frame of the entry, which its name
    tells), "tuple", "number", "gains" (kp and kv), "tuning" (kp, kv, bound and delay) or "memory".
    """

    name: str
    kind: str
    size: int = 1


class Entry(NamedTuple):
    """A function of an export; it returns what `returns` declares, and the new memory if it takes one."""

    name: str
    function: Callable
    parameters: tuple[Parameter, ...]
    returns: Parameter
    doc: str

    @property
    def has_memory(self) -> bool:
        """Tell whether it takes a memory."""
        return any(one.kind == "memory" for one in self.parameters)

    @property
    def width(self) -> int:
        """Return the count of numbers that it is given."""
        return sum(one.size for one in self.parameters)

    @property
    def about(self) -> str:
        """Return what it returns, and how its matrices are stored."""
        matrices = [one.name for one in (*self.parameters, self.returns) if one.size == 9]
        return f"{self.doc}; {', '.join(matrices)} by rows: {matrices[0]}[3*i+j]" if matrices else self.doc


class Frame(NamedTuple):
    """The frame of an entry's vectors: a suffix of its name, and the kernels (R, v) that convert its vectors."""

    suffix: str
    to_base: Callable
    from_base: Callable
    to_body: Callable
    from_body: Callable


@kernel
def keep(R, v):
    """Return v, whose frame is the wanted one."""
    return v


FRAMES = (Frame("", keep, keep, rotate_back, rotate), Frame("_body", rotate, rotate_back, keep, keep))
Declared = tuple[tuple[Parameter, ...], Parameter, str]
"""The parameters of an entry, its result, and its docstring."""


def in_both_frames(make: Callable[[Frame], Iterable[Callable]], *declared: Declared) -> list[Entry]:
    """Return the entries of the functions that `make` returns for each frame, declared in their order."""
    entries = []
    for frame in FRAMES:
        for function, (parameters, returns, doc) in zip(make(frame), declared, strict=True):
            function.__name__ = f"{function.__name__.removesuffix('_with_memory')}{frame.suffix}"
            named = (
                one._replace(name=one.name + frame.suffix * (one.kind == "vector")) for one in (*parameters, returns)
            )
            *given, result = named
            entries.append(Entry(function.__name__, function, tuple(given), result, doc))
    return entries


R, R_D = Parameter("R", "matrix", 9), Parameter("R_d", "matrix", 9)
OMEGA, U, MOMENT, E, TAU = (Parameter(name, "vector", 3) for name in ("omega", "u", "moment", "e", "tau"))
OMEGA_D, ALPHA_D = Parameter("omega_d", "vector", 3), Parameter("alpha_d", "vector", 3)
GAINS, INERTIA = Parameter("gains", "gains", 2), Parameter("inertia_body", "rows", 9)
TUNING = Parameter("gains", "tuning", 4)
REGULATING = Gains(1.0, 2.0)
"""The gains of the orientation error: stiffness 1, critically damped as the paper's gains are."""

UNLIMITED = Tuning(*REGULATING, bound=1e30)
"""The gains of the orientation error of a law that reads a bound. No command reaches this bound, and every language can
write it, in single precision too."""

ACCELERATION = "angular acceleration u [rad/s^2] that the law commands"
TRACKING = (
    "angular acceleration u [rad/s^2] that the law commands towards a goal that turns at omega_d [rad/s], alpha_d "
    "[rad/s^2]: alpha_d + omega_d x (omega - omega_d) + the law's own u at omega - omega_d"
)
ERROR = "error of orientation e [rad near the goal], towards the goal: u at rest over Kp, at Kv^2 = 4 Kp"
TORQUE = "torque tau [N m] that gives a rigid body the angular acceleration u; inertia_body [kg m^2]: in the body frame"


@kernel
def product(inertia, v):
    """Return I v, I by rows."""
    return (
        dot((inertia[0], inertia[1], inertia[2]), v),
        dot((inertia[3], inertia[4], inertia[5]), v),
        dot((inertia[6], inertia[7], inertia[8]), v),
    )


@kernel
def torque_in_body(omega_body, u_body, inertia):
    """Return I u + omega x I omega, which gives a rigid body the acceleration u (Euler's equation), body frame."""
    p, g = product(inertia, u_body), cross(omega_body, product(inertia, omega_body))
    return (p[0] + g[0], p[1] + g[1], p[2] + g[2])


def of_torque() -> list[Entry]:
    """Return the torque of an angular acceleration, in both frames."""

    def make(frame: Frame) -> tuple[Callable, ...]:
        to_body, from_body = frame.to_body, frame.from_body

        @kernel
        def torque(R, omega, u, inertia):
            return from_body(R, torque_in_body(to_body(R, omega), to_body(R, u), inertia))

        return (torque,)

    return in_both_frames(make, ((R, OMEGA, U, INERTIA), TAU, TORQUE))


SEEN = from_quaternion((0.8, 0.0, 0.6, 0.0)), from_quaternion((10 / 11, 1 / 11, 2 / 11, 4 / 11))
"""R and R_d at which a law is called to see what it keeps in memory."""


def name_numbers(name: str, found: tuple, quat_wxyz: tuple) -> str:
    """Return the name of four numbers, which ends in _wxyz if they are a multiple of the quaternion."""
    p, q = np.array(found), np.array(quat_wxyz)
    return f"{name}_wxyz" if abs(p @ q) > (1.0 - 1e-9) * np.linalg.norm(p) * np.linalg.norm(q) else name


def of_law(law: Callable, memory: tuple | None) -> list[Entry]:
    """Return angular acceleration, also for a moving goal, orientation error and torque of a regulator, in both frames.

    memory: the first one; None of a law without memory. A law that reads the limits of its motors takes them as
    arguments after the gains.
    """
    given, regulating = (TUNING, UNLIMITED) if reads_limits(law) else (GAINS, REGULATING)

    def make(frame: Frame) -> tuple[Callable, ...]:
        _suffix, to_base, from_base, _to_body, _from_body = frame

        @kernel
        def angular_acceleration(R, omega, R_d, gains):
            return from_base(R, law(R, to_base(R, omega), Goal(R_d, AT_REST, AT_REST), gains))

        @kernel
        def tracking_acceleration(R, omega, R_d, omega_d, alpha_d, gains):
            u = angular_acceleration(R, minus(omega, omega_d), R_d, gains)
            return carried_along(u, omega, omega_d, alpha_d)  # in the entry's frame: a cross product turns with it

        @kernel
        def orientation_error(R, R_d):
            return angular_acceleration(R, AT_REST, R_d, regulating)

        @kernel
        def angular_acceleration_with_memory(R, omega, R_d, gains, memory):
            u, kept = law(R, to_base(R, omega), Goal(R_d, AT_REST, AT_REST), gains, memory)
            return from_base(R, u), kept

        @kernel
        def tracking_acceleration_with_memory(R, omega, R_d, omega_d, alpha_d, gains, memory):
            u, kept = angular_acceleration_with_memory(R, minus(omega, omega_d), R_d, gains, memory)
            return carried_along(u, omega, omega_d, alpha_d), kept

        @kernel
        def orientation_error_with_memory(R, R_d, memory):
            return angular_acceleration_with_memory(R, AT_REST, R_d, regulating, memory)

        if memory is None:
            return angular_acceleration, tracking_acceleration, orientation_error
        return angular_acceleration_with_memory, tracking_acceleration_with_memory, orientation_error_with_memory

    kept: tuple[Parameter, ...] = ()
    if memory is not None:
        (w, v, _), (_u, after) = turn_quaternion(*SEEN), law(SEEN[0], AT_REST, Goal(SEEN[1]), regulating, memory)
        kept = (Parameter(name_numbers("memory", after, (w, *v)), "memory", 4),)
    both = in_both_frames(
        make,
        ((R, OMEGA, R_D, given, *kept), U, ACCELERATION),
        ((R, OMEGA, R_D, OMEGA_D, ALPHA_D, given, *kept), U, TRACKING),
        ((R, R_D, *kept), E, ERROR),
    )
    return [*both, *of_torque()]


def of_impedance(law: Callable) -> list[Entry]:
    """Return the angular acceleration of an impedance under a moment, and the torque, in both frames."""

    def make(frame: Frame) -> tuple[Callable, ...]:
        to_base, from_base = frame.to_base, frame.from_base

        @kernel
        def angular_acceleration(R, omega, moment, R_d, gains, apparent_inertia):
            return from_base(R, law(R, to_base(R, omega), to_base(R, moment), R_d, gains, apparent_inertia))

        return (angular_acceleration,)

    given = (R, OMEGA, MOMENT, R_D, GAINS, Parameter("apparent_inertia", "number"))
    return [*in_both_frames(make, (given, U, f"{ACCELERATION} under a moment [N m]")), *of_torque()]
