"""Robots commanded by velocities: a body that follows at once, and an arm whose joints follow at once or with a lag.

Kinematics are MuJoCo's, the motion the judge's exact step: there is no dynamics. On an arm the controller resolves
(K (p_d - p), omega) by the geometric Jacobian and an inverse, with the identity for D.
"""

import math
from typing import NamedTuple

from bench.engines.arm_episode import squared
from bench.engines.arrays import Matrix
from bench.engines.episode import FIRST_METRIC
from bench.engines.loop import Action, Controller, Plant, Record, Sensed, episodes_of
from bench.engines.mujoco_view import Simulated, compute
from bench.engines.plants import arm, quaternion
from bench.law.contenders.jacobians.geometric import fill
from bench.law.control.velocity import velocity
from bench.law.inputs import AT_REST
from bench.law.scalar import atan2, kernel, sqrt
from bench.law.so3 import cross, dot
from tasks.truth import angle
from tasks.velocity import Servo, followed, turned
from tasks.verdict import GOING, check_command

PATH, FURTHEST, BENT, PEAK, RATE, OFF = range(FIRST_METRIC, FIRST_METRIC + 6)
"""A row's columns after the judge's: path turned [rad], greatest haversine, greatest angle [rad] by which the limiter
bent a command, greatest |omega| [rad/s]; on arms greatest |qdot| [rad/s] and distance of the tool from its place [m],
of which the free body has none."""


class Pace(NamedTuple):
    """K [1/s], and what a tick makes of a servo's lag."""

    K: float
    servo: Servo


class VelocityWorld(NamedTuple):
    """An arm, of each start its state, buffers with the identity for D, and the pace."""

    sim: Simulated
    states: Matrix
    work: arm.ArmWork
    pace: Pace


class Unlimited(NamedTuple):
    """A velocity before the limiter; of joints their squared rate, and how far the tool is from its place [m]."""

    omega: tuple
    rate: float
    off: float


@kernel
def begin(laws, memory0, sensed):
    """Start with the law's own memory, and no command."""
    return memory0, Action(AT_REST, AT_REST, 0.0, math.nan, GOING, Unlimited(AT_REST, 0.0, 0.0))


@kernel
def command(laws, body, sensed, now, gains, memory, numbers):
    """Command an angular velocity: laws are the law and its limiter, limit(omega, K) -> omega."""
    u, memory, _ = laws.law(sensed.R, AT_REST, sensed.goal, gains, memory)
    unlimited, omega = velocity(laws.second, u, body.K, gains.kp)
    speed = dot(omega, omega)
    failure = check_command(speed, numbers.speed_limit_squared)
    return Action(omega, u, speed, math.nan, failure, Unlimited(unlimited, 0.0, 0.0)), memory


@kernel
def follow(laws, body, state, action, gains, memory, numbers):
    """Turn the body by its velocity times dt."""
    dt, omega = numbers.dt, action.u
    quat = turned(state.quat, (dt * omega[0], dt * omega[1], dt * omega[2]))
    return quaternion.QuaternionState(quat, omega, state.quat_d, dt * sqrt(action.squared)), memory


@kernel
def see(row, curves, now, body, sensed, action, before, numbers):
    """Keep the greatest angle, bend and speed."""
    unlimited, omega, hav = action.extra.omega, action.u, sensed.haversine
    turned_off, along = cross(unlimited, omega), dot(unlimited, omega)
    bend = atan2(sqrt(dot(turned_off, turned_off)), along)
    speed = sqrt(dot(omega, omega))
    row[FURTHEST] = max(row[FURTHEST], hav)
    row[BENT] = bend if bend > row[BENT] and speed > 0.0 else row[BENT]
    row[PEAK] = max(row[PEAK], speed)


@kernel
def see_body(row, curves, now, body, sensed, action, before, numbers):
    """Keep the greatest of what is seen of a body, but not of a command that fails."""
    if action.failure == GOING:
        see(row, curves, now, body, sensed, action, before, numbers)


@kernel
def see_arm(row, curves, now, body, sensed, action, before, numbers):
    """Keep the greatest of what is seen of an arm."""
    see(row, curves, now, body, sensed, action, before, numbers)
    off, rate = action.extra.off, sqrt(action.extra.rate)
    row[OFF] = max(row[OFF], off)
    row[RATE] = rate if action.failure == GOING and rate > row[RATE] else row[RATE]


@kernel
def account(row, body, state, sensed, action, tick, numbers):
    """Add up the path."""
    row[PATH] += state.path


@kernel
def reset_at_rest(body, k, start):
    """Place the body at a start, at rest."""
    quat, _, quat_d, path = quaternion.reset(body, k, start)
    return quaternion.QuaternionState(quat, AT_REST, quat_d, path)


@kernel
def command_joints(laws, body, sensed, now, gains, memory, numbers):
    """Command joint rates, written into x: laws are the law, its limiter, and an inverse."""
    buffers, K, tool, n, off = body.work.buffers, body.pace.K, sensed.extra, body.sim.n, 0.0
    u, memory, _ = laws.law(sensed.R, AT_REST, sensed.goal, gains, memory)
    unlimited, omega = velocity(laws.second, u, K, gains.kp)
    for i in range(3):
        buffers.a[i] = K * (tool.p_d[i] - tool.p[i])
        buffers.a[3 + i] = omega[i]
        off = off + (tool.p_d[i] - tool.p[i]) * (tool.p_d[i] - tool.p[i])
    fill(buffers.J, tool.chain)
    laws.third(buffers.J, buffers.a, body.work.D, buffers.x, 6, n, buffers.scratch)
    rate = squared(buffers.x, n)
    failure = check_command(rate, numbers.speed_limit_squared)
    return Action(
        omega, u, dot(u, u), math.nan, failure, Unlimited(unlimited, rate, sqrt(off))
    ), memory


@kernel
def follow_with_joints(laws, body, state, action, gains, memory, numbers):
    """Let the joints' servos follow."""
    sim, s = body.sim, body.sim.sensordata
    before = (s[12], s[13], s[14], s[15])
    for i in range(sim.n):
        angle_turned, rate_after = followed(sim.qvel[i], body.work.buffers.x[i], body.pace.servo)
        sim.qpos[i] += angle_turned
        sim.qvel[i] = rate_after
    compute(sim)
    return arm.ArmPlantState(
        state.quat_d, state.goal, state.p_d, angle(before, (s[12], s[13], s[14], s[15]))
    ), memory


@kernel
def sense_unlimited(body, state, tick, numbers):
    """Read the sensors; a command is limited, and so no speed is."""
    R, omega, goal, hav, watched, _, rest, ended_by, tool = arm.sense(body, state, tick, numbers)
    return Sensed(R, omega, goal, hav, watched, 0.0, rest, ended_by, tool)


def of_body():
    """Return the loop of the free body."""
    plant = Plant(reset_at_rest, quaternion.sense, follow, quaternion.measure)
    return episodes_of(plant, Controller(begin, command), Record(see_body, account))


def of_arm():
    """Return the loop of arms."""
    plant = Plant(arm.reset, sense_unlimited, follow_with_joints, arm.measure)
    return episodes_of(plant, Controller(begin, command_joints), Record(see_arm, account))
