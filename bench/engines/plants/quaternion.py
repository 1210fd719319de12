"""Bodies of inertia 1 kept as a quaternion: behind a stream of goals, and with a law whose state is integrated too.

Behind a stream the command is held over a tick: omega grows by u dt, and the body turns by their mean times dt. A law
with a state is one system with the body in continuous time, which a constant disturbance pushes: one Runge-Kutta step
a tick.
"""

import math
from typing import NamedTuple

from bench.engines.arrays import Matrix, Three
from bench.engines.episode import FIRST_METRIC
from bench.engines.ideal import plus
from bench.engines.loop import (
    NO_ACTION,
    Action,
    Controller,
    Plant,
    Record,
    Sensed,
    accelerate,
    begin,
    episodes_of,
)
from bench.law.inputs import AT_REST, NO_MEMORY, Goal
from bench.law.scalar import kernel, sqrt
from bench.law.so3 import cross, dot, from_quaternion
from tasks.truth import angle, haversine
from tasks.velocity import turned
from tasks.verdict import GOING, check_command

PEAK, OFF, PATH = range(FIRST_METRIC, FIRST_METRIC + 3)
"""A row's columns after the judge's: greatest |u| [rad/s^2], greatest angle to the true goal, path turned [rad]."""


class QuaternionState(NamedTuple):
    """The body, its goal, and the angle of its last rotation [rad]."""

    quat: tuple
    omega: tuple
    quat_d: tuple
    path: float


@kernel
def reset(body, k, start):
    """Place the body at a start."""
    quat_d = (start[7], start[8], start[9], start[10])
    return QuaternionState(
        (start[0], start[1], start[2], start[3]), (start[4], start[5], start[6]), quat_d, 0.0
    )


@kernel
def sense(body, state, tick, numbers):
    """Give the state itself."""
    quat, omega, quat_d, _ = state
    goal, speed = Goal(from_quaternion(quat_d), AT_REST, AT_REST), dot(omega, omega)
    hav = haversine(quat, quat_d)
    return Sensed(from_quaternion(quat), omega, goal, hav, speed, 0.0, speed, GOING, (quat, quat_d))


@kernel
def measure(body, state, sensed):
    """Measure the angle to the goal."""
    return angle(state.quat, state.quat_d)


@kernel
def see(row, curves, now, body, sensed, action, before, numbers):
    """Keep the greatest command."""
    row[PEAK] = max(row[PEAK], sqrt(dot(action.u, action.u)))


class SentGoals(NamedTuple):
    """Goals as they come and as they are, a quaternion each tick; is_raw: the spring on it as it came commands."""

    goals: Matrix
    truth: Matrix
    is_raw: int


@kernel
def sense_stream(body, state, tick, numbers):
    """Give the state, and the goal of this tick; after the last one there is none other."""
    i = min(tick, body.goals.shape[0] - 1)
    quat_d = (body.goals[i, 0], body.goals[i, 1], body.goals[i, 2], body.goals[i, 3])
    return sense(body, QuaternionState(state.quat, state.omega, quat_d, state.path), tick, numbers)


@kernel
def follow_stream(laws, body, sensed, now, gains, memory, numbers):
    """Command what the law says, or the spring on the quaternion as it came, whose sign is the stream's."""
    if body.is_raw:
        q, (w, x, y, z) = sensed.extra
        omega = sensed.omega
        e_x = w * -q[1] + x * q[0] - y * q[3] + z * q[2]
        e_y = w * -q[2] + y * q[0] - z * q[1] + x * q[3]
        e_z = w * -q[3] + z * q[0] - x * q[2] + y * q[1]
        s = 2.0 * gains.kp
        u = (s * e_x - gains.kv * omega[0], s * e_y - gains.kv * omega[1], s * e_z - gains.kv * omega[2])
        return Action(u, u, dot(u, u), math.nan, GOING, ()), memory
    return accelerate(laws, body, sensed, now, gains, memory, numbers)


@kernel
def hold_over_tick(laws, body, state, action, gains, memory, numbers):
    """Let omega grow by u dt, and turn the body by their mean times dt."""
    omega, u, dt = state.omega, action.u, numbers.dt
    h = 0.5 * dt * dt
    turn = (dt * omega[0] + h * u[0], dt * omega[1] + h * u[1], dt * omega[2] + h * u[2])
    omega = (omega[0] + dt * u[0], omega[1] + dt * u[1], omega[2] + dt * u[2])
    return QuaternionState(
        turned(state.quat, turn), omega, state.quat_d, sqrt(dot(turn, turn))
    ), memory


@kernel
def account_for_stream(row, body, state, sensed, action, tick, numbers):
    """Add up the path, and keep the greatest angle to the true goal."""
    true = body.truth[tick - 1]
    row[PATH] += state.path
    row[OFF] = max(row[OFF], angle(state.quat, (true[0], true[1], true[2], true[3])))


class Disturbance(NamedTuple):
    """A constant acceleration [rad/s^2], base frame."""

    push: Three


@kernel
def shifted(p, h, v):
    """p + h v, of four numbers."""
    return (p[0] + h * v[0], p[1] + h * v[1], p[2] + h * v[2], p[3] + h * v[3])


@kernel
def spun(q, omega):
    """Return the rate of the quaternion (w, x, y, z): (0, omega) o q/2, omega in the base frame."""
    v = (q[1], q[2], q[3])
    p, along = cross(omega, v), dot(omega, v)
    return (
        -0.5 * along,
        0.5 * (q[0] * omega[0] + p[0]),
        0.5 * (q[0] * omega[1] + p[1]),
        0.5 * (q[0] * omega[2] + p[2]),
    )


@kernel
def unit(q):
    """q/|q|."""
    shorter = 1.0 / sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
    return (shorter * q[0], shorter * q[1], shorter * q[2], shorter * q[3])


@kernel
def sense_unit(body, state, tick, numbers):
    """Give the state, R of a unit quaternion."""
    quat, omega, quat_d, _ = state
    goal, R = Goal(from_quaternion(quat_d), AT_REST, AT_REST), from_quaternion(unit(quat))
    return Sensed(R, omega, goal, haversine(quat, quat_d), 0.0, 0.0, 0.0, GOING, (quat, quat_d))


@kernel
def begin_state(laws, memory0, sensed):
    """Start with the law's own state, its rate, and no command."""
    return (laws.second(from_quaternion(sensed.extra[0])), NO_MEMORY), NO_ACTION


@kernel
def command_with_state(laws, body, sensed, now, gains, memory, numbers):
    """Command what the law says."""
    u, rate = laws.law(sensed.R, sensed.omega, sensed.goal, gains, memory[0])
    squared = dot(u, u)
    failure = check_command(squared, numbers.command_limit_squared)
    return Action(u, u, squared, math.nan, failure, ()), (memory[0], rate)


@kernel
def integrate(laws, body, state, action, gains, memory, numbers):
    """Take the body and the law's state one Runge-Kutta step on under the disturbance."""
    h, u = numbers.dt, action.u
    first, rate = memory
    goal = Goal(from_quaternion(state.quat_d), AT_REST, AT_REST)
    q_sum, omega_sum, state_sum = state.quat, state.omega, first
    at, pace, kept = state.quat, state.omega, first
    for stage in range(4):
        if stage > 0:
            u, rate = laws.law(from_quaternion(unit(at)), pace, goal, gains, kept)
        share = h / 6.0 if stage == 0 or stage == 3 else h / 3.0
        turning, gained = spun(at, pace), plus(u, 1.0, body.push)
        q_sum, omega_sum = shifted(q_sum, share, turning), plus(omega_sum, share, gained)
        state_sum = shifted(state_sum, share, rate)
        ahead = h if stage == 2 else 0.5 * h
        at, pace = shifted(state.quat, ahead, turning), plus(state.omega, ahead, gained)
        kept = shifted(first, ahead, rate)
    return QuaternionState(unit(q_sum), omega_sum, state.quat_d, 0.0), (state_sum, rate)


def streamed():
    """Return the loop behind streams of goals."""
    plant = Plant(reset, sense_stream, hold_over_tick, measure)
    return episodes_of(plant, Controller(begin, follow_stream), Record(see, account_for_stream))


def with_state():
    """Return the loop of laws with a state: its functions are law(R, omega, goal, gains, state) and begin(R)."""
    plant = Plant(reset, sense_unit, integrate, measure)
    return episodes_of(plant, Controller(begin_state, command_with_state), Record(see))
