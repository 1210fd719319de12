"""An arm under an impedance that shapes no inertia, with an account of its energy.

    V(t) - V(0) = -damped - elbow + added          V = qdot^T M qdot/2 + U

damped: of the hand's damping; elbow: of the null space's; added: by what is compensated beside gravity, or taken by
friction that is not. Torques are held over a tick, in which the joints go on by the mean of their rates at its ends.
"""

import math
from typing import NamedTuple

import numpy as np

from bench.engines.arm_episode import MOST, load
from bench.engines.arrays import Matrix, Vector
from bench.engines.episode import FIRST_METRIC
from bench.engines.loop import Action, Controller, Record, episodes_of
from bench.engines.mujoco_view import Simulated, compute, fill_inertia
from bench.engines.plants import arm
from bench.law.chain import twist
from bench.law.contenders.jacobians.geometric import fill
from bench.law.control.unshaped import apparent_inertia, damp_elbow
from bench.law.inputs import AT_REST
from bench.law.linalg import multiply, multiply_transposed
from bench.law.scalar import kernel, sqrt
from bench.law.so3 import dot, minus
from tasks.verdict import GOING, check_command

OVERSHOOT, OFF, LEFT, STRAIN, KINETIC, DAMPED, ELBOW, ADDED = range(FIRST_METRIC, FIRST_METRIC + 8)
"""A row's columns after the judge's: greatest component of the error of orientation against its first direction, over
its first length; greatest and last distance of the tool from its place [m]; greatest torque over the rated one; kinetic
energy at the end [J]; and of the energy's account what is damped, lost in the elbow and added [J]."""
COLUMNS = (0.0,) * 8
"""Their start values."""


class Springs(NamedTuple):
    """Stiffness of translation [N/m] and of turns [N m/rad], the desired damping ratio, and what is compensated.

    is_whole: 1 if Coriolis torques and friction are compensated with gravity, 0 if gravity alone is.
    """

    translation: float
    rotation: float
    zeta: float
    is_whole: int


class ImpedanceWorld(NamedTuple):
    """The arm, of each start its state, another arm that stands where it is, for gravity, buffers and springs.

    K: stiffnesses. v, e: the tool's velocity, and the springs' wrench. damp, elbow, added: torques [N m]; before: rates
    at the beginning of a tick. rated: torques [N m]. ends: q and qdot at the end of each episode.
    """

    sim: Simulated
    states: Matrix
    still: Simulated
    work: arm.ArmWork
    springs: Springs
    D: Matrix
    K: Vector
    v: Vector
    e: Vector
    damp: Vector
    elbow: Vector
    added: Vector
    before: Vector
    rated: Vector
    ends: Matrix


def world(
    sim: Simulated, still: Simulated, states: np.ndarray, springs: Springs, rated
) -> ImpedanceWorld:
    """Return the world of an arm under springs."""
    n = sim.n
    K = np.repeat((springs.translation, springs.rotation), 3)
    D, ends = np.zeros((MOST, MOST)), np.zeros((len(states), 2 * n))
    (v, e), (damp, elbow, added, before) = np.zeros((2, 6)), np.zeros((4, n))
    of_joints = {"damp": damp, "elbow": elbow, "added": added, "before": before, "rated": np.array(rated, dtype=float)}
    return ImpedanceWorld(
        sim, states, still, arm.work(n), springs, D, K, v, e, ends=ends, **of_joints
    )


@kernel
def begin(laws, memory0, sensed):
    """Start with the law's own memory; more than the command is kept the first one."""
    return (memory0, AT_REST), Action(AT_REST, AT_REST, 0.0, math.nan, GOING, AT_REST)


@kernel
def command(laws, body, sensed, now, gains, memory, numbers):
    """Compute the torques of springs, damping and what is compensated; laws are the law and the design of damping."""
    sim, still, springs, work, n = body.sim, body.still, body.springs, body.work, body.sim.n
    J, w, x, tau = work.buffers.J, work.buffers.a, work.buffers.x, work.buffers.tau
    for i in range(n):
        still.qpos[i] = sim.qpos[i]
    compute(still)
    fill_inertia(sim, work.D)
    fill(J, sensed.extra.chain)
    apparent_inertia(J, work.D, work.G, n, work.buffers.scratch)
    laws.second(body.K, work.G, springs.zeta, body.D, work.buffers.scratch)
    u, law, _ = laws.law(sensed.R, AT_REST, sensed.goal, gains, memory[0])
    pdot, omega = twist(sensed.extra.chain)
    away = minus(sensed.extra.p_d, sensed.extra.p)
    for i in range(3):
        body.e[i], body.e[3 + i] = springs.translation * away[i], springs.rotation * u[i] / gains.kp
        body.v[i], body.v[3 + i] = pdot[i], omega[i]
    multiply(body.D, body.v, w, 6, 6)
    multiply_transposed(J, w, body.damp, 6, n)
    multiply_transposed(J, body.e, tau, 6, n)
    if n > 6:
        damp_elbow(J, work.D, work.G, sim.qvel, body.v, n, w, x, body.elbow)
    for i in range(n):
        gravity, passive = still.qfrc_bias[i], sim.qfrc_passive[i]
        beside = sim.qfrc_bias[i] - passive - gravity
        body.added[i] = beside + passive if springs.is_whole > 0 else passive
        tau[i] += gravity + body.elbow[i] - body.damp[i] + (beside if springs.is_whole > 0 else 0.0)
        body.before[i] = sim.qvel[i]
    total, _ = load(tau, body.rated, n)
    failure, first = (
        check_command(total, numbers.command_limit_squared),
        u if now.number == 0 else memory[1],
    )
    return Action(u, u, dot(u, u), math.nan, failure, first), (law, first)


@kernel
def see(row, curves, now, body, sensed, action, before, numbers):
    """Keep the greatest strain, overshoot and distance."""
    _, largest = load(body.work.buffers.tau, body.rated, body.sim.n)
    row[STRAIN] = max(row[STRAIN], sqrt(largest))
    against, square = -dot(action.u, action.extra), dot(action.extra, action.extra)
    if against > row[OVERSHOOT] * square:
        row[OVERSHOOT] = against / square
    away = minus(sensed.extra.p_d, sensed.extra.p)
    off = sqrt(dot(away, away))
    row[OFF] = max(row[OFF], off)


@kernel
def account(row, body, state, sensed, action, tick, numbers):
    """Add up the work of a tick."""
    for i in range(body.sim.n):
        turned = 0.5 * numbers.dt * (body.before[i] + body.sim.qvel[i])
        row[DAMPED] += body.damp[i] * turned
        row[ELBOW] -= body.elbow[i] * turned
        row[ADDED] += body.added[i] * turned


@kernel
def close(row, body, state, k, numbers):
    """Measure the kinetic energy and where the arm ends."""
    sim, s, tau, n = body.sim, body.sim.sensordata, body.work.buffers.tau, body.sim.n
    fill_inertia(sim, body.work.D)
    multiply(body.work.D, sim.qvel, tau, n, n)
    row[KINETIC], away = 0.0, minus(state.p_d, (s[16], s[17], s[18]))
    row[LEFT] = sqrt(dot(away, away))
    for i in range(n):
        row[KINETIC] += 0.5 * sim.qvel[i] * tau[i]
        body.ends[k, i], body.ends[k, n + i] = sim.qpos[i], sim.qvel[i]


def of_arm():
    """Return the loop, for all arms."""
    return episodes_of(arm.ARM, Controller(begin, command), Record(see, account, close))
