"""Robots commanded by velocities: a body that follows at once, and an arm whose joints follow at once or with a lag.

Kinematics are MuJoCo's, the motion the judge's exact step: there is no dynamics. On an arm the controller resolves
(K (p_d - p), omega) by the geometric Jacobian and an inverse, with the identity for D.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from bench.contenders.jacobians.geometric import fill
from bench.control.resolved_acceleration import Buffers
from bench.control.velocity import velocity
from bench.engines.arm_episode import squared
from bench.engines.compiled import EVALUATE, THREE, compile_loop, float64, types
from bench.engines.episode import FIRST_METRIC, blank
from bench.engines.loop import Controller, Record, episodes_of, pass_on
from bench.engines.native.arm import RESOLVE, WORKSPACE, Workspace, open_workspace
from bench.engines.native.libmujoco import mj_step1
from bench.engines.native.pointers import matrix
from bench.engines.plants import arm, quaternion
from bench.law.contender import AT_REST
from bench.law.scalar import atan2, kernel, sqrt
from bench.law.so3 import cross, dot
from tasks.truth import angle
from tasks.velocity import followed, turned
from tasks.verdict import GOING, check_command

PATH, FURTHEST, BENT, PEAK, RATE, OFF = range(FIRST_METRIC, FIRST_METRIC + 6)
"""A row's columns after the judge's: path turned [rad], greatest haversine, greatest angle [rad] by which the limiter
bent a command, greatest |omega| [rad/s]; on arms greatest |qdot| [rad/s] and distance of the tool from its place [m],
of which the free body has none."""


class Pace(NamedTuple):
    """K [1/s], and the tick [s] and what it makes of a servo's lag: see tasks.velocity.Servo."""

    K: float
    dt: float
    decay: float
    coast: float


class Laws(NamedTuple):
    """The law, its limiter limit(omega, K) -> omega, and on arms an inverse."""

    evaluate: Any
    limit: Any
    resolve: Any


class Orders(NamedTuple):
    """The pace, and on arms buffers."""

    pace: Pace
    work: Workspace


class Desk(NamedTuple):
    """The pace, the identity, and the buffers."""

    pace: Pace
    identity: Any
    buffers: Buffers


class VelocityAct(NamedTuple):
    """`loop.Act` of a velocity; asked: before the limiter. rate: squared, of the joints; off: of the tool [m]."""

    u: tuple
    given: tuple
    squared: float
    margin: float
    failure: int
    asked: tuple
    rate: float
    off: float


NO_ACT = VelocityAct(AT_REST, AT_REST, 0.0, math.nan, GOING, AT_REST, 0.0, 0.0)


@kernel
def begin(laws, memory0, sensed):
    """Start with the law's own memory, and no command."""
    return memory0, NO_ACT


@kernel
def command(laws, body, pace, state, sensed, now, gains, memory, numbers):
    """Command an angular velocity."""
    u, memory, _ = laws.evaluate(sensed.R, AT_REST, sensed.goal, gains, memory)
    asked, omega = velocity(laws.limit, u, pace.K, gains.kp)
    speed = dot(omega, omega)
    failure = check_command(speed, numbers.speed_limit_squared)
    return VelocityAct(omega, u, speed, math.nan, failure, asked, 0.0, 0.0), memory


@kernel
def follow(laws, body, pace, state, act, gains, memory, numbers):
    """Turn the body by its velocity times dt."""
    dt, omega = numbers.dt, act.u
    quat = turned(state.quat, (dt * omega[0], dt * omega[1], dt * omega[2]))
    return quaternion.State(quat, omega, state.quat_d, state.goal, dt * sqrt(act.squared)), memory


@kernel
def see_greatest(row, haversine, asked, omega):
    """Keep the greatest angle, bend and speed."""
    turned_off, along = cross(asked, omega), dot(asked, omega)
    bend = atan2(sqrt(dot(turned_off, turned_off)), along)
    speed = sqrt(dot(omega, omega))
    row[FURTHEST] = haversine if haversine > row[FURTHEST] else row[FURTHEST]
    row[BENT] = bend if bend > row[BENT] and speed > 0.0 else row[BENT]
    row[PEAK] = speed if speed > row[PEAK] else row[PEAK]


@kernel
def see(row, curves, now, body, desk, state, sensed, act, before, numbers):
    """Keep the greatest of what is seen of a body, but not of a command that fails."""
    if act.failure == GOING:
        see_greatest(row, now.haversine, act.asked, act.u)


@kernel
def account(row, body, desk, state, act, tick, numbers):
    """Add up the path."""
    row[PATH] += state.path


@kernel
def reset_body(body, k, start):
    """Place the body at a start, at rest."""
    state = quaternion.reset(body, k, start)
    return quaternion.State(state.quat, AT_REST, state.quat_d, state.goal, 0.0)


@kernel
def ready(orders):
    """Return the buffers' arrays, and the identity for D."""
    n = orders.work.n
    identity = matrix(orders.work.D, n, n)
    for i in range(n):
        for j in range(n):
            identity[i, j] = 1.0 if i == j else 0.0
    return Desk(orders.pace, identity, open_workspace(orders.work))


@kernel
def command_joints(laws, robot, desk, state, sensed, now, gains, memory, numbers):
    """Command joint rates, written into the desk's x."""
    pace, buffers, n = desk.pace, desk.buffers, robot.body.n
    u, memory, _ = laws.evaluate(sensed.R, AT_REST, sensed.goal, gains, memory)
    asked, omega = velocity(laws.limit, u, pace.K, gains.kp)
    p, p_d, off = sensed.p, sensed.p_d, 0.0
    for i in range(3):
        buffers.a[i] = pace.K * (p_d[i] - p[i])
        buffers.a[3 + i] = omega[i]
        off = off + (p_d[i] - p[i]) * (p_d[i] - p[i])
    fill(buffers.J, sensed.chain)
    laws.resolve(buffers.J, buffers.a, desk.identity, buffers.x, 6, n, buffers.scratch)
    rate = squared(buffers.x, n)
    failure = check_command(rate, numbers.speed_limit_squared)
    return VelocityAct(omega, u, dot(u, u), math.nan, failure, asked, rate, sqrt(off)), memory


@kernel
def follow_with_joints(laws, robot, desk, state, act, gains, memory, numbers):
    """Let the joints' servos follow."""
    body, s = robot.body, robot.body.s
    before = (s[12], s[13], s[14], s[15])
    for i in range(body.n):
        angle_turned, rate_after = followed(body.qdot[i], desk.buffers.x[i], desk.pace)
        body.q[i] += angle_turned
        body.qdot[i] = rate_after
    mj_step1(body.model, body.data)
    path = angle(before, (s[12], s[13], s[14], s[15]))
    return arm.State(state.quat_d, state.goal, state.p_d, path), memory


@kernel
def see_on_arm(row, curves, now, robot, desk, state, sensed, act, before, numbers):
    """Keep the greatest of what is seen of an arm."""
    see_greatest(row, now.haversine, act.asked, act.u)
    row[OFF] = act.off if act.off > row[OFF] else row[OFF]
    if act.failure == GOING:
        row[RATE] = sqrt(act.rate) if sqrt(act.rate) > row[RATE] else row[RATE]


PACE = types.NamedUniTuple(float64, 4, Pace)
ORDERS = types.NamedTuple((PACE, WORKSPACE), Orders)
LIMIT = THREE(THREE, float64)


def compile_body():
    """Compile the loop of the free body."""
    plant = quaternion.BODY._replace(reset=reset_body, advance=follow)
    loop = episodes_of(plant, Controller(Laws, pass_on, begin, command), Record(see, account))
    return compile_loop(loop, (EVALUATE, LIMIT), orders=PACE)


def compile_arm():
    """Compile the loop of arms."""
    plant = arm.ARM._replace(advance=follow_with_joints, check=quaternion.check)
    loop = episodes_of(plant, Controller(Laws, ready, begin, command_joints), Record(see_on_arm, account))
    return compile_loop(loop, (EVALUATE, LIMIT, RESOLVE), arm.WORLD, ORDERS)


def blank_rows(count: int, on_arm: bool) -> np.ndarray:
    """Rows to be filled."""
    rows = np.hstack((blank(count, ()), np.zeros((count, 6))))
    rows[:, OFF] = 0.0 if on_arm else math.nan
    return rows
