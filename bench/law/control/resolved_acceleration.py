"""The controller of an arm: tau = D J^-1 (u - Jdot qdot) + fg.

With the geometric Jacobian u is the tool's acceleration (Murphy 1988, 2.2); with the analytic one it commands the
coordinates themselves (3.7). In two halves, so that each law and each inverse is compiled once for all arms:

    assemble(chain, goal, p_d, gains, memory, J, a) -> (u, memory)    fills J and a = u - Jdot qdot
    resolve(J, a, D, x, rows, n, scratch)                             the inverse: fills x

and `control`, which calls the two and turns x into torques.

Position is held by the same gains, u_p = Kp (p_d - p) - Kv pdot, as the paper proposes for it (2.1). On seven joints
null-space motion is damped: see `relax`.

Limitations: where J has no inverse; with the analytic Jacobian also where the coordinates are singular.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

from bench.base.errors import Incompatible
from bench.law.chain import Scratch, bias_acceleration, twist
from bench.law.contender import Contender
from bench.law.kinds import Coordinates
from bench.law.linalg import multiply
from bench.law.scalar import kernel
from bench.law.so3 import minus, spring_damper


@kernel
def hold(p, p_d, pdot, gains):
    """u_p = Kp (p_d - p) - Kv pdot [m/s^2], base frame."""
    return spring_damper(gains.kp, minus(p_d, p), gains.kv, pdot)


BY_JOINT = 2
"""What an inverse gives, as a number for a compiled loop: accelerations are 0, torques 1, torques of a baseline on the
joints 2. That one finds in `a` what the joints are off their goal, and on J's diagonal their inertia."""


class Parts(NamedTuple):
    """The functions a controller is made of; counting puts its own in their place, which know their stage.

    command: law(R, omega, goal, gains, memory) -> (u, memory), or on an analytic Jacobian the coordinate law.
    fill: the Jacobian's. convert: its `express` (2.2) or its `drift` (3.7).
    coordinates: those that an analytic Jacobian is of; report: their `accelerate`, called for the record only.
    assemble: of a baseline, in place of all of them.
    """

    command: Callable
    fill: Callable
    convert: Callable
    coordinates: Coordinates | None = None
    report: Callable | None = None
    twist: Callable = twist
    bias_acceleration: Callable = bias_acceleration
    hold: Callable = hold
    assemble: Callable | None = None


def parts_of(contender: Contender, command: Callable) -> Parts:
    """Return the parts of a contender on an arm; command: its law in the form `Parts.command` says."""
    jacobian, representation = contender.jacobian, contender.representation
    assemble = None if contender.baseline is None else contender.baseline.assemble
    if jacobian is None:
        raise Incompatible(f"'{contender.name}' names no Jacobian; on an arm it is {contender.name}@geometric+solve")
    if jacobian.takes == "coordinates" and representation is not None:
        fill, drift = jacobian.kernels_in(representation)
        return Parts(command, fill, drift, representation, representation.accelerate)
    fill, express = jacobian.kernels_in(None)
    return Parts(command, fill, express, assemble=assemble)


def assembly(parts: Parts) -> Callable:
    """Return the first half of the controller; with coordinates among its parts that of (3.7), else that of (2.2)."""
    if parts.assemble is not None:
        return parts.assemble
    return _on_geometric(parts) if parts.coordinates is None else _on_analytic(parts, parts.coordinates)


def _on_geometric(parts: Parts) -> Callable:
    command, fill, express = parts.command, parts.fill, parts.convert
    twist_of, bias_of, hold_at = parts.twist, parts.bias_acceleration, parts.hold

    @kernel
    def assemble(chain, goal, p_d, gains, memory, J, a):
        """J, and a = (u_p, u) - Jdot qdot in the frame of J (Murphy 1988, 2.2)."""
        pdot, omega = twist_of(chain)
        u, memory = command(chain.R, omega, goal, gains, memory)
        u_p = hold_at(chain.p, p_d, pdot, gains)
        bias = bias_of(chain)
        fill(J, chain)
        wanted = express(
            chain,
            (u_p[0] - bias[0], u_p[1] - bias[1], u_p[2] - bias[2], u[0] - bias[3], u[1] - bias[4], u[2] - bias[5]),
        )
        for i in range(6):
            a[i] = wanted[i]
        return u, memory

    return assemble


def _on_analytic(parts: Parts, coordinates: Coordinates) -> Callable:
    command, fill, drift_of, report = parts.command, parts.fill, parts.convert, parts.report or coordinates.accelerate
    chart, goal_chart, rates = coordinates.chart, coordinates.goal_chart, coordinates.rates
    twist_of, bias_of, hold_at = parts.twist, parts.bias_acceleration, parts.hold

    @kernel
    def assemble(chain, goal, p_d, gains, memory, J, a):
        """J_E, and a = (u_p, u_E) - Jdot_E qdot (Murphy 1988, 3.7); u, for the record, is B u_E + Bdot Edot."""
        pdot, omega = twist_of(chain)
        at = chart(chain.R)
        Edot = rates(at, omega)
        u_E = command(at, goal_chart(goal.R).E, Edot, gains)
        u_p = hold_at(chain.p, p_d, pdot, gains)
        drift = drift_of(chain, at, Edot, omega, bias_of(chain))
        fill(J, chain, at)
        for i in range(3):
            a[i] = u_p[i] - drift[i]
        for i in range(len(u_E)):
            a[3 + i] = u_E[i] - drift[3 + i]
        return report(at, Edot, u_E), memory

    return assemble


@kernel
def relax(J, a, chain, gains, rows, x):
    """Take from a what the damping of the joints would do to the tool: a - J z, z = -Kv/2 qdot; x is overwritten.

    With x = J^+ (a - J z) + z on seven joints the tool moves as commanded, J x = a, and the motion it does not see
    dies out with the time constant 2/Kv, the double pole's of the paper's gains. Six joints need none of it.
    """
    multiply(J, chain.qdot, x, rows, chain.n)
    half = 0.5 * gains.kv
    for i in range(rows):
        a[i] = a[i] + half * x[i]


@kernel
def damp(x, chain, gains):
    """Add the damping z of `relax` to the joint accelerations."""
    half = 0.5 * gains.kv
    for i in range(chain.n):
        x[i] = x[i] - half * chain.qdot[i]


@kernel
def accelerate_joints(D, x, fg, n, tau):
    """tau = D x + fg (Murphy 1988, 2.1), x the accelerations of the joints."""
    multiply(D, x, tau, n, n)
    for i in range(n):
        tau[i] = tau[i] + fg[i]


@kernel
def push_joints(D, x, chain, gains, fg, tau):
    """tau = x + fg, x torques; on seven joints with the torque D z of the damping of `relax`."""
    if chain.n > 6:
        multiply(D, chain.qdot, tau, chain.n, chain.n)
        half = 0.5 * gains.kv
        for i in range(chain.n):
            x[i] = x[i] - half * tau[i]
    for i in range(chain.n):
        tau[i] = x[i] + fg[i]


class Buffers(NamedTuple):
    """What a controller writes into: J (7 x 7), a and x (7), tau (n), and the inverse's scratch."""

    J: Any
    a: Any
    x: Any
    tau: Any
    scratch: Scratch


@kernel
def control(assemble, resolve, gives_torque, rows, chain, D, fg, goal, p_d, gains, memory, buffers):
    """One tick of a controller: tau into the buffers; returns u, the commanded angular acceleration, and the memory.

    D (n x n) is the inertia matrix [kg m^2]; fg (n) the torques of gravity, Coriolis and friction [N m]. rows and
    gives_torque (0, 1, or BY_JOINT) are those of the Jacobian and the inverse.
    """
    J, a, x = buffers.J, buffers.a, buffers.x
    u, memory = assemble(chain, goal, p_d, gains, memory, J, a)
    if chain.n > 6 and gives_torque < BY_JOINT:
        relax(J, a, chain, gains, rows, x)
    resolve(J, a, D, x, rows, chain.n, buffers.scratch)
    if gives_torque == BY_JOINT:
        for i in range(chain.n):
            buffers.tau[i] = x[i] + fg[i]
    elif gives_torque > 0:
        push_joints(D, x, chain, gains, fg, buffers.tau)
    else:
        if chain.n > 6:
            damp(x, chain, gains)
        accelerate_joints(D, x, fg, chain.n, buffers.tau)
    return u, memory
