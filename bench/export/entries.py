"""What an exported law is asked: its command, its error of orientation, a body's torque; in any frame, from any form.

Each is a function of the law dialect around the law and is translated with it, so that no language has formulas of its
own. Without a suffix vectors are in the base frame and an orientation is a matrix. `_body`: vectors are in the body's
frame. `_wxyz`, `_xyzw`: orientations are quaternions in that order, of any length but zero.
"""

from collections.abc import Callable
from typing import NamedTuple

from bench.law import (
    AT_REST,
    Gains,
    Goal,
    Representation,
    cross,
    dot,
    from_quaternion,
    kernel,
    rotate,
    rotate_back,
    sqrt,
)


class Parameter(NamedTuple):
    """An argument of an entry: what it is called, what it is, and how many numbers it has.

    kind: "matrix", "tuple", "number", "gains" (kp and kv) or "memory".
    """

    name: str
    kind: str
    size: int = 1


class Entry(NamedTuple):
    """A function that an export offers; its result is a tuple, a matrix or a number, and with memory the new memory."""

    name: str
    function: Callable
    parameters: tuple[Parameter, ...]
    returns: str
    doc: str

    @property
    def has_memory(self) -> bool:
        """Whether it takes a memory, and returns the new one beside its result."""
        return any(one.kind == "memory" for one in self.parameters)


GAINS, MEMORY = Parameter("gains", "gains", 2), Parameter("memory", "memory", 4)
INERTIA = Parameter("inertia", "tuple", 9)
REGULATING = Gains(1.0, 2.0)
"""Of the error of orientation: stiffness 1, critically damped as the paper's gains are."""


@kernel
def as_matrix(R):
    """A matrix is given."""
    return R


@kernel
def from_wxyz(quat_wxyz):
    """The rotation of a quaternion (w, x, y, z) of any length but zero."""
    w, x, y, z = quat_wxyz
    shorter = 1.0 / sqrt(w * w + x * x + y * y + z * z)
    return from_quaternion((shorter * w, shorter * x, shorter * y, shorter * z))


@kernel
def from_xyzw(quat_xyzw):
    """The rotation of a quaternion (x, y, z, w) of any length but zero."""
    x, y, z, w = quat_xyzw
    return from_wxyz((w, x, y, z))


class Form(NamedTuple):
    """How an orientation is given: suffix, what makes a rotation of it, and the arguments R and R_d in that form."""

    suffix: str
    read: Callable
    R: Parameter
    R_d: Parameter


FORMS = (
    Form("", as_matrix, Parameter("R", "matrix", 9), Parameter("R_d", "matrix", 9)),
    *(
        Form(f"_{order}", read, Parameter(f"quat_{order}", "tuple", 4), Parameter(f"quat_d_{order}", "tuple", 4))
        for order, read in (("wxyz", from_wxyz), ("xyzw", from_xyzw))
    ),
)


@kernel
def product(inertia, v):
    """I v, I by rows."""
    return (
        dot((inertia[0], inertia[1], inertia[2]), v),
        dot((inertia[3], inertia[4], inertia[5]), v),
        dot((inertia[6], inertia[7], inertia[8]), v),
    )


@kernel
def torque_in_body(omega_body, u_body, inertia):
    """I u + omega x I omega: what gives a rigid body the acceleration u (Euler's equation), all in the body's frame."""
    p, g = product(inertia, u_body), cross(omega_body, product(inertia, omega_body))
    return (p[0] + g[0], p[1] + g[1], p[2] + g[2])


COMMAND = "angular acceleration u [rad/s^2]"
ERROR = "error of orientation e [rad near the goal], towards the goal: the command at rest over Kp, at Kv^2 = 4 Kp"
TORQUE = "torque [N m] on a rigid body of that inertia [kg m^2], which is in the body's frame in every entry"


def of_law(law: Callable, has_memory: bool) -> list[Entry]:
    """Of a regulator: its command, its error and a body's torque, in both frames and every form."""
    found, wanted = [], (("command", COMMAND), ("orientation_error", ERROR), ("torque", TORQUE))
    for form in FORMS:
        made = (_keeping if has_memory else _forgetting)(law, form)
        kept = (MEMORY,) if has_memory else ()
        for frame in ("", "_body"):
            omega = Parameter(f"omega{frame}", "tuple", 3)
            given = {
                "command": (form.R, omega, form.R_d, GAINS, *kept),
                "orientation_error": (form.R, form.R_d, *kept),
                "torque": (form.R, omega, form.R_d, GAINS, INERTIA, *kept),
            }
            for name, doc in wanted:
                found.append(named_entry(f"{name}{frame}", form, made, given[name], doc))
    return found


def _forgetting(law: Callable, form: Form) -> dict[str, Callable]:
    """Entries of a law without memory."""
    read = form.read

    @kernel
    def command(R, omega, R_d, gains):
        return law(read(R), omega, Goal(read(R_d), AT_REST, AT_REST), gains)

    @kernel
    def command_body(R, omega_body, R_d, gains):
        at = read(R)
        u = law(at, rotate(at, omega_body), Goal(read(R_d), AT_REST, AT_REST), gains)
        return rotate_back(at, u)

    @kernel
    def orientation_error(R, R_d):
        return command(R, AT_REST, R_d, REGULATING)

    @kernel
    def orientation_error_body(R, R_d):
        return command_body(R, AT_REST, R_d, REGULATING)

    @kernel
    def torque_body(R, omega_body, R_d, gains, inertia):
        return torque_in_body(omega_body, command_body(R, omega_body, R_d, gains), inertia)

    @kernel
    def torque(R, omega, R_d, gains, inertia):
        at = read(R)
        return rotate(at, torque_body(R, rotate_back(at, omega), R_d, gains, inertia))

    return {one.__name__: one for one in locals().values() if callable(one) and one not in (law, read)}


def _keeping(law: Callable, form: Form) -> dict[str, Callable]:
    """Entries of a law with memory: they return the new memory too."""
    read = form.read

    @kernel
    def command(R, omega, R_d, gains, memory):
        return law(read(R), omega, Goal(read(R_d), AT_REST, AT_REST), gains, memory)

    @kernel
    def command_body(R, omega_body, R_d, gains, memory):
        at = read(R)
        u, kept = law(at, rotate(at, omega_body), Goal(read(R_d), AT_REST, AT_REST), gains, memory)
        return rotate_back(at, u), kept

    @kernel
    def orientation_error(R, R_d, memory):
        return command(R, AT_REST, R_d, REGULATING, memory)

    @kernel
    def orientation_error_body(R, R_d, memory):
        return command_body(R, AT_REST, R_d, REGULATING, memory)

    @kernel
    def torque_body(R, omega_body, R_d, gains, inertia, memory):
        u_body, kept = command_body(R, omega_body, R_d, gains, memory)
        return torque_in_body(omega_body, u_body, inertia), kept

    @kernel
    def torque(R, omega, R_d, gains, inertia, memory):
        at = read(R)
        tau, kept = torque_body(R, rotate_back(at, omega), R_d, gains, inertia, memory)
        return rotate(at, tau), kept

    return {one.__name__: one for one in locals().values() if callable(one) and one not in (law, read)}


def of_impedance(law: Callable) -> list[Entry]:
    """Of an impedance: its command under a moment, in both frames and every form."""
    found = []
    for form in FORMS:
        made = _yielding(law, form)
        for frame in ("", "_body"):
            omega, moment = Parameter(f"omega{frame}", "tuple", 3), Parameter(f"moment{frame}", "tuple", 3)
            given = (form.R, omega, moment, form.R_d, GAINS, Parameter("apparent_inertia", "number"))
            found.append(named_entry(f"command{frame}", form, made, given, f"{COMMAND} under a moment [N m]"))
    return found


def named_entry(name: str, form: Form, made: dict[str, Callable], given: tuple[Parameter, ...], doc: str) -> Entry:
    """The entry of that name for a form; its function takes the name too, for others of the form call it."""
    function = made[name]
    function.__name__ = f"{name}{form.suffix}"
    return Entry(function.__name__, function, given, "tuple", doc)


def _yielding(law: Callable, form: Form) -> dict[str, Callable]:
    read = form.read

    @kernel
    def command(R, omega, moment, R_d, gains, apparent_inertia):
        return law(read(R), omega, moment, read(R_d), gains, apparent_inertia)

    @kernel
    def command_body(R, omega_body, moment_body, R_d, gains, apparent_inertia):
        at = read(R)
        u = law(at, rotate(at, omega_body), rotate(at, moment_body), read(R_d), gains, apparent_inertia)
        return rotate_back(at, u)

    return {"command": command, "command_body": command_body}


def of_representation(one: Representation) -> list[Entry]:
    """Of coordinates: to and from a rotation, B and B^-1 with what they do to rates, accelerations and moments."""
    size = len(one.symbols)
    chart, chart_of, to_matrix = one.chart, one.chart_of, one.to_matrix
    push, pull, accelerate, convert = one.angular_velocity, one.rates, one.accelerate, one.generalized
    margin_of = one.margin
    E, Edot, Eddot = (Parameter(name, "tuple", size) for name in ("E", "Edot", "Eddot"))
    omega, moment = Parameter("omega", "tuple", 3), Parameter("moment", "tuple", 3)

    @kernel
    def rotation(E):
        return to_matrix(E)

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
        *(named_entry("coordinates", form, _read(chart, form.read), (form.R,), "E of R") for form in FORMS),
        Entry("rotation", rotation, (E,), "matrix", "R of E"),
        Entry("rates", rates, (E, omega), "tuple", "Edot = B^-1 omega"),
        Entry("angular_velocity", angular_velocity, (E, Edot), "tuple", "omega = B Edot"),
        Entry("angular_acceleration", angular_acceleration, (E, Edot, Eddot), "tuple", "B Eddot + Bdot Edot"),
        Entry("generalized_forces", generalized_forces, (E, moment), "tuple", "B^T m"),
        Entry("margin", _number(margin_of), (FORMS[0].R,), "number", "in [0, 1], 0 exactly where B^-1 does not exist"),
    ]


def _read(chart: Callable, read: Callable) -> dict[str, Callable]:
    @kernel
    def coordinates(R):
        return chart(read(R)).E

    return {"coordinates": coordinates}


def _number(margin_of: Callable) -> Callable:
    @kernel
    def margin(R):
        return margin_of(R)

    return margin
