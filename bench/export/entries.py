"""Entries of an export: the functions that its files offer, in the base frame and in the body frame.

An entry is a function of the law dialect around the law and is translated with it, so that no language has formulas of
its own. Vectors are in the base frame; where the name of an entry ends in `_body` they are in the body frame.
"""

from collections.abc import Callable, Iterable
from typing import NamedTuple

from bench.law import AT_REST, Coordinates, Gains, Goal, cross, dot, kernel, rotate, rotate_back


class Parameter(NamedTuple):
    """An argument of an entry: its name, its kind and how many numbers it has.

    kind: "matrix" (a rotation), "rows" (another matrix, by rows), "vector" (in the frame of the entry, which its name
    tells), "tuple", "number", "gains" (kp and kv) or "memory".
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
GAINS, MEMORY = Parameter("gains", "gains", 2), Parameter("memory", "memory", 4)
INERTIA = Parameter("inertia", "rows", 9)
REGULATING = Gains(1.0, 2.0)
"""The gains of the orientation error: stiffness 1, critically damped as the paper's gains are."""

COMMAND = "angular acceleration u [rad/s^2]"
ERROR = "error of orientation e [rad near the goal], towards the goal: the command at rest over Kp, at Kv^2 = 4 Kp"
TORQUE = "torque [N m] that gives a rigid body the command u; inertia [kg m^2] is in the body frame in every entry"


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


def of_law(law: Callable, has_memory: bool) -> list[Entry]:
    """Return the command and the orientation error of a regulator, and the torque of a command, in both frames."""

    def make(frame: Frame) -> tuple[Callable, ...]:
        _suffix, to_base, from_base, to_body, from_body = frame

        @kernel
        def command(R, omega, R_d, gains):
            return from_base(R, law(R, to_base(R, omega), Goal(R_d, AT_REST, AT_REST), gains))

        @kernel
        def orientation_error(R, R_d):
            return command(R, AT_REST, R_d, REGULATING)

        @kernel
        def command_with_memory(R, omega, R_d, gains, memory):
            u, kept = law(R, to_base(R, omega), Goal(R_d, AT_REST, AT_REST), gains, memory)
            return from_base(R, u), kept

        @kernel
        def orientation_error_with_memory(R, R_d, memory):
            return command_with_memory(R, AT_REST, R_d, REGULATING, memory)

        @kernel
        def torque(R, omega, u, inertia):
            return from_body(R, torque_in_body(to_body(R, omega), to_body(R, u), inertia))

        if has_memory:
            return command_with_memory, orientation_error_with_memory, torque
        return command, orientation_error, torque

    kept = (MEMORY,) if has_memory else ()
    return in_both_frames(
        make,
        ((R, OMEGA, R_D, GAINS, *kept), U, COMMAND),
        ((R, R_D, *kept), E, ERROR),
        ((R, OMEGA, U, INERTIA), TAU, TORQUE),
    )


def of_impedance(law: Callable) -> list[Entry]:
    """Return the command of an impedance under a moment, in both frames."""

    def make(frame: Frame) -> tuple[Callable, ...]:
        to_base, from_base = frame.to_base, frame.from_base

        @kernel
        def command(R, omega, moment, R_d, gains, apparent_inertia):
            return from_base(R, law(R, to_base(R, omega), to_base(R, moment), R_d, gains, apparent_inertia))

        return (command,)

    given = (R, OMEGA, MOMENT, R_D, GAINS, Parameter("apparent_inertia", "number"))
    return in_both_frames(make, (given, U, f"{COMMAND} under a moment [N m]"))


def of_representation(record: Coordinates) -> list[Entry]:
    """Return the entries of coordinates: to and from R, B, B^-1 and B^T, base frame."""
    size = len(record.symbols)
    chart, chart_of = record.chart, record.chart_of
    push, pull, accelerate, convert = record.angular_velocity, record.rates, record.accelerate, record.generalized
    E, Edot, Eddot, F = (Parameter(name, "tuple", size) for name in ("E", "Edot", "Eddot", "F"))
    alpha, number = Parameter("alpha", "vector", 3), Parameter("margin", "number")

    @kernel
    def coordinates(R):
        return chart(R).E

    @kernel
    def rates(E, omega):
        return pull(chart_of(E), omega)

    @kernel
    def angular_velocity(E, Edot):
        return push(chart_of(E), Edot)

    @kernel
    def angular_acceleration(E, Edot, Eddot):
        return accelerate(chart_of(E), Edot, Eddot)

    @kernel
    def generalized_forces(E, moment):
        return convert(chart_of(E), moment)

    return [
        Entry("coordinates", coordinates, (R,), E, "E of R"),
        Entry("rotation", record.to_matrix, (E,), R, "R of E"),
        Entry("rates", rates, (E, OMEGA), Edot, "Edot = B^-1 omega"),
        Entry("angular_velocity", angular_velocity, (E, Edot), OMEGA, "omega = B Edot"),
        Entry("angular_acceleration", angular_acceleration, (E, Edot, Eddot), alpha, "B Eddot + Bdot Edot"),
        Entry("generalized_forces", generalized_forces, (E, MOMENT), F, "B^T m"),
        Entry("margin", record.margin, (R,), number, "in [0, 1], 0 exactly where B^-1 does not exist"),
    ]
