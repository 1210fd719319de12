"""An arm under an impedance that shapes no inertia, with an account of its energy.

    V(t) - V(0) = -damped - elbow + added          V = qdot^T M qdot/2 + U

damped: of the hand's damping; elbow: of the null space's; added: by what is compensated beside gravity, or taken by
friction that is not. Torques are held over a tick, in which the joints go on by the mean of their rates at its ends.
"""

from typing import Any, NamedTuple

import numpy as np

from bench.contenders.jacobians.geometric import fill
from bench.control.resolved_acceleration import Buffers
from bench.control.unshaped import apparent_inertia, damp_elbow
from bench.engines.arm_episode import MOST
from bench.engines.compiled import EVALUATE, MATRIX, compile_loop, float64, int64, types
from bench.engines.episode import FIRST_METRIC, blank
from bench.engines.loop import Controller, Record, episodes_of
from bench.engines.native.arm import (
    ARM_VIEW,
    SCRATCH,
    VECTOR,
    WORKSPACE,
    ArmView,
    Body,
    Workspace,
    open_view,
    open_workspace,
)
from bench.engines.native.libmujoco import mj_fullM, mj_step1
from bench.engines.native.pointers import matrix, vector
from bench.engines.plants import arm
from bench.law.chain import twist
from bench.law.contender import AT_REST
from bench.law.linalg import multiply, multiply_transposed
from bench.law.scalar import kernel, sqrt
from bench.law.so3 import dot, minus
from tasks.verdict import GOING, check_command

OVERSHOOT, OFF, LEFT, STRAIN, KINETIC, DAMPED, ELBOW, ADDED = range(FIRST_METRIC, FIRST_METRIC + 8)
"""A row's columns after the judge's: greatest component of the error of orientation against its first direction, over
its first length; greatest and last distance of the tool from its place [m]; greatest torque over the rated one; kinetic
energy at the end [J]; and of the energy's account what is damped, lost in the elbow and added [J]."""


class Springs(NamedTuple):
    """Stiffness of translation [N/m] and of turns [N m/rad], the ratio that is asked for, and what is compensated.

    is_whole: 1 if Coriolis torques and friction are compensated with gravity, 0 if gravity alone is.
    """

    translation: float
    rotation: float
    zeta: float
    is_whole: int


class Laws(NamedTuple):
    """The law of the error of orientation, and the design of damping."""

    evaluate: Any
    design: Any
    third: Any


class Orders(NamedTuple):
    """An arm that stands where the plant is, for gravity; buffers, springs, torques [N m], and room for the ends.

    room: the address of 14 x 7 numbers. ends: q and qdot at the end of each episode.
    """

    still: ArmView
    work: Workspace
    room: int
    springs: Springs
    rated: Any
    ends: Any


class Desk(NamedTuple):
    """The arrays of `Orders`, D (7 x 7), and vectors: of six numbers K, v, e; of the joints the others."""

    still: Body
    buffers: Buffers
    M: Any
    Lambda: Any
    M_address: int
    D: Any
    K: Any
    v: Any
    e: Any
    damp: Any
    elbow: Any
    added: Any
    before: Any
    springs: Springs
    rated: Any
    ends: Any


class ImpedanceAct(NamedTuple):
    """`loop.Act` of an impedance; first: the first command."""

    u: tuple
    given: tuple
    squared: float
    margin: float
    failure: int
    first: tuple


NO_ACT = ImpedanceAct(AT_REST, AT_REST, 0.0, 0.0, GOING, AT_REST)


class Memory(NamedTuple):
    """The law's memory, and its first command."""

    law: tuple
    first: tuple


@kernel
def ready(orders):
    """Return the arrays."""
    work, n, row = orders.work, orders.work.n, 8 * MOST
    at = orders.room + MOST * row
    K, v, e = vector(at, 6), vector(at + row, 6), vector(at + 2 * row, 6)
    damp, elbow = vector(at + 3 * row, n), vector(at + 4 * row, n)
    added, before = vector(at + 5 * row, n), vector(at + 6 * row, n)
    for i in range(3):
        K[i], K[3 + i] = orders.springs.translation, orders.springs.rotation
    M, Lambda, D = matrix(work.D, n, n), matrix(work.G, MOST, MOST), matrix(orders.room, MOST, MOST)
    return Desk(
        open_view(orders.still), open_workspace(work), M, Lambda, work.D, D,
        K, v, e, damp, elbow, added, before, orders.springs, orders.rated, orders.ends,
    )  # fmt: skip


@kernel
def begin(laws, memory0, sensed):
    """Start with the law's own memory, and no command."""
    return Memory(memory0, AT_REST), NO_ACT


@kernel
def command(laws, robot, desk, state, sensed, now, gains, memory, numbers):
    """Compute the torques: those of the springs and the damping, and what is compensated."""
    body, still, springs, n = robot.body, desk.still, desk.springs, robot.body.n
    J, w, x, tau = desk.buffers.J, desk.buffers.a, desk.buffers.x, desk.buffers.tau
    for i in range(n):
        still.q[i] = body.q[i]
    mj_step1(still.model, still.data)
    mj_fullM(body.model, body.data, desk.M_address)
    fill(J, sensed.chain)
    apparent_inertia(J, desk.M, desk.Lambda, n, desk.buffers.scratch)
    laws.design(desk.K, desk.Lambda, springs.zeta, desk.D, desk.buffers.scratch)
    u, law, _ = laws.evaluate(sensed.R, AT_REST, sensed.goal, gains, memory.law)
    pdot, omega = twist(sensed.chain)
    away = minus(sensed.p_d, sensed.p)
    for i in range(3):
        desk.e[i], desk.e[3 + i] = springs.translation * away[i], springs.rotation * u[i] / gains.kp
        desk.v[i], desk.v[3 + i] = pdot[i], omega[i]
    multiply(desk.D, desk.v, w, 6, 6)
    multiply_transposed(J, w, desk.damp, 6, n)
    multiply_transposed(J, desk.e, tau, 6, n)
    if n > 6:
        damp_elbow(J, desk.M, desk.Lambda, body.qdot, desk.v, n, w, x, desk.elbow)
    total = 0.0
    for i in range(n):
        gravity, passive = still.bias[i], body.passive[i]
        beside = body.bias[i] - passive - gravity
        desk.added[i] = beside + passive if springs.is_whole > 0 else passive
        tau[i] += gravity + desk.elbow[i] - desk.damp[i] + (beside if springs.is_whole > 0 else 0.0)
        ratio, desk.before[i] = tau[i] / desk.rated[i], body.qdot[i]
        total = total + ratio * ratio
    failure = check_command(total, numbers.command_limit_squared)
    first = u if now.tick == 0 else memory.first
    return ImpedanceAct(u, u, dot(u, u), 0.0, failure, first), Memory(law, first)


@kernel
def see(row, curves, now, robot, desk, state, sensed, act, before, numbers):
    """Keep the greatest strain, overshoot and distance."""
    for i in range(robot.body.n):
        ratio = desk.buffers.tau[i] / desk.rated[i]
        size = sqrt(ratio * ratio)
        row[STRAIN] = size if size > row[STRAIN] else row[STRAIN]
    against, square = -dot(act.u, act.first), dot(act.first, act.first)
    if against > row[OVERSHOOT] * square:
        row[OVERSHOOT] = against / square
    away = minus(sensed.p_d, sensed.p)
    off = sqrt(dot(away, away))
    row[OFF] = off if off > row[OFF] else row[OFF]


@kernel
def account(row, robot, desk, state, act, tick, numbers):
    """Add up the work of a tick."""
    for i in range(robot.body.n):
        turned = 0.5 * numbers.dt * (desk.before[i] + robot.body.qdot[i])
        row[DAMPED] += desk.damp[i] * turned
        row[ELBOW] -= desk.elbow[i] * turned
        row[ADDED] += desk.added[i] * turned


@kernel
def close(row, robot, desk, state, k, numbers):
    """Measure the kinetic energy and where the arm ends."""
    body, s, tau, n = robot.body, robot.body.s, desk.buffers.tau, robot.body.n
    mj_fullM(body.model, body.data, desk.M_address)
    multiply(desk.M, body.qdot, tau, n, n)
    row[KINETIC], away = 0.0, minus(state.p_d, (s[16], s[17], s[18]))
    row[LEFT] = sqrt(dot(away, away))
    for i in range(n):
        row[KINETIC] += 0.5 * body.qdot[i] * tau[i]
        desk.ends[k, i], desk.ends[k, n + i] = body.q[i], body.qdot[i]


SPRINGS = types.NamedTuple((float64, float64, float64, int64), Springs)
ORDERS = types.NamedTuple((ARM_VIEW, WORKSPACE, int64, SPRINGS, VECTOR, MATRIX), Orders)
DESIGN = types.void(VECTOR, MATRIX, float64, MATRIX, SCRATCH)


def compile_arm():
    """Compile the loop, for all arms."""
    loop = episodes_of(arm.ARM, Controller(Laws, ready, begin, command), Record(see, account, close))
    return compile_loop(loop, (EVALUATE, DESIGN), arm.WORLD, ORDERS)


def blank_rows(count: int) -> np.ndarray:
    """Rows to be filled."""
    return np.hstack((blank(count, ()), np.zeros((count, 8))))
