"""Bodies of inertia 1 kept as a quaternion: behind a stream of goals, and with a law whose state is integrated too.

Behind a stream the command is held over a tick: omega grows by u dt, and the body turns by their mean times dt. A law
with a state is one system with the body in continuous time, which a constant disturbance pushes: one Runge-Kutta step
a tick.
"""

from typing import Any, NamedTuple

from bench.engines.compiled import EVALUATE, FOUR, GAINS, GOAL, MATRIX, ROTATION, THREE, compile_loop, types
from bench.engines.controllers import ACCELERATION, accelerate
from bench.engines.episode import FIRST_METRIC
from bench.engines.ideal import plus
from bench.engines.loop import NO_ACT, Act, Controller, Plant, Record, episodes_of, pass_on
from bench.law.contender import AT_REST, NO_MEMORY, Goal
from bench.law.scalar import kernel, sqrt
from bench.law.so3 import Rotation, cross, dot, from_quaternion
from tasks.truth import angle, haversine
from tasks.velocity import turned
from tasks.verdict import GOING, check_command

PEAK, OFF, PATH = range(FIRST_METRIC, FIRST_METRIC + 3)
"""A row's columns after the judge's: greatest |u| [rad/s^2], greatest angle to the true goal, path turned [rad]."""


class State(NamedTuple):
    """The body, its goal, and the angle of its last rotation [rad]."""

    quat: tuple
    omega: tuple
    quat_d: tuple
    goal: Goal
    path: float


class Sensed(NamedTuple):
    """What the controller is given: the state, and R."""

    R: Rotation
    omega: tuple
    goal: Goal
    quat: tuple
    quat_d: tuple


@kernel
def reset(body, k, start):
    """Place the body at a start."""
    quat_d = (start[7], start[8], start[9], start[10])
    goal = Goal(from_quaternion(quat_d), AT_REST, AT_REST)
    return State((start[0], start[1], start[2], start[3]), (start[4], start[5], start[6]), quat_d, goal, 0.0)


@kernel
def sense(body, state):
    """Give the state itself."""
    return Sensed(from_quaternion(state.quat), state.omega, state.goal, state.quat, state.quat_d)


@kernel
def look(body, state, tick, numbers):
    """Compare the body with its goal."""
    return state, haversine(state.quat, state.quat_d), dot(state.omega, state.omega)


@kernel
def check(body, state, numbers):
    """End no episode."""
    return GOING


@kernel
def end(body, state):
    """Measure the last angle and speed."""
    return angle(state.quat, state.quat_d), dot(state.omega, state.omega)


@kernel
def see(row, curves, now, body, desk, state, sensed, act, before, numbers):
    """Keep the greatest command."""
    row[PEAK] = max(row[PEAK], sqrt(dot(act.u, act.u)))


@kernel
def stand(laws, body, desk, state, act, gains, memory, numbers):
    """Move nothing: in this place a body has its motion."""
    return state, memory


BODY = Plant(pass_on, reset, sense, look, stand, check, end)


class Stream(NamedTuple):
    """Goals as they come and as they are: quaternions, one a tick."""

    goals: Any
    truth: Any


@kernel
def look_at_stream(body, state, tick, numbers):
    """Give the body the goal of this tick; after the last one it has that."""
    i = min(tick, body.goals.shape[0] - 1)
    quat_d = (body.goals[i, 0], body.goals[i, 1], body.goals[i, 2], body.goals[i, 3])
    goal = Goal(from_quaternion(quat_d), AT_REST, AT_REST)
    return State(state.quat, state.omega, quat_d, goal, state.path), 1.0, 0.0


@kernel
def follow_stream(laws, body, is_raw, state, sensed, now, gains, memory, numbers):
    """Command what the law says, or the spring on the quaternion as it came, whose sign is the stream's."""
    if is_raw:
        (w, x, y, z), q, omega = sensed.quat_d, sensed.quat, sensed.omega
        e_x = w * -q[1] + x * q[0] - y * q[3] + z * q[2]
        e_y = w * -q[2] + y * q[0] - z * q[1] + x * q[3]
        e_z = w * -q[3] + z * q[0] - x * q[2] + y * q[1]
        s = 2.0 * gains.kp
        u = (s * e_x - gains.kv * omega[0], s * e_y - gains.kv * omega[1], s * e_z - gains.kv * omega[2])
        return Act(u, u, dot(u, u), 0.0, GOING), memory
    return accelerate(laws, body, is_raw, state, sensed, now, gains, memory, numbers)


@kernel
def hold_over_tick(laws, body, desk, state, act, gains, memory, numbers):
    """Let omega grow by u dt, and turn the body by their mean times dt."""
    omega, u, dt = state.omega, act.u, numbers.dt
    h = 0.5 * dt * dt
    turn = (dt * omega[0] + h * u[0], dt * omega[1] + h * u[1], dt * omega[2] + h * u[2])
    omega = (omega[0] + dt * u[0], omega[1] + dt * u[1], omega[2] + dt * u[2])
    return State(turned(state.quat, turn), omega, state.quat_d, state.goal, sqrt(dot(turn, turn))), memory


@kernel
def account_for_stream(row, body, desk, state, act, tick, numbers):
    """Add up the path, and keep the greatest angle to the true goal."""
    true = body.truth[tick - 1]
    row[PATH] += state.path
    row[OFF] = max(row[OFF], angle(state.quat, (true[0], true[1], true[2], true[3])))


class Stateful(NamedTuple):
    """The functions of a law with a state: law(R, omega, goal, gains, state) -> (u, rate), begin(R) -> state."""

    law: Any
    begin: Any
    third: Any


class Progress(NamedTuple):
    """A law's state, and its rate."""

    state: tuple
    rate: tuple


@kernel
def shifted(p, h, v):
    """p + h v, of four numbers."""
    return (p[0] + h * v[0], p[1] + h * v[1], p[2] + h * v[2], p[3] + h * v[3])


@kernel
def spun(q, omega):
    """The rate of the quaternion (w, x, y, z): (0, omega) o q/2, omega in the base frame."""
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
def sense_unit(body, state):
    """Give the state, R of a unit quaternion."""
    return Sensed(from_quaternion(unit(state.quat)), state.omega, state.goal, state.quat, state.quat_d)


@kernel
def begin_state(laws, memory0, sensed):
    """Start with the law's own state, and no command."""
    return Progress(laws.begin(from_quaternion(sensed.quat)), NO_MEMORY), NO_ACT


@kernel
def command_with_state(laws, body, desk, state, sensed, now, gains, memory, numbers):
    """Command what the law says."""
    u, rate = laws.law(sensed.R, sensed.omega, sensed.goal, gains, memory.state)
    squared = dot(u, u)
    return Act(u, u, squared, 0.0, check_command(squared, numbers.command_limit_squared)), Progress(memory.state, rate)


@kernel
def integrate(laws, d, desk, state, act, gains, memory, numbers):
    """Take the body and the law's state one Runge-Kutta step on under the disturbance d [rad/s^2]."""
    h, u, rate = numbers.dt, act.u, memory.rate
    q_sum, omega_sum, state_sum = state.quat, state.omega, memory.state
    at, pace, kept = state.quat, state.omega, memory.state
    for stage in range(4):
        if stage > 0:
            u, rate = laws.law(from_quaternion(unit(at)), pace, state.goal, gains, kept)
        share = h / 6.0 if stage == 0 or stage == 3 else h / 3.0
        turning, gained = spun(at, pace), plus(u, 1.0, d)
        q_sum, omega_sum = shifted(q_sum, share, turning), plus(omega_sum, share, gained)
        state_sum = shifted(state_sum, share, rate)
        ahead = h if stage == 2 else 0.5 * h
        at, pace = shifted(state.quat, ahead, turning), plus(state.omega, ahead, gained)
        kept = shifted(memory.state, ahead, rate)
    return State(unit(q_sum), omega_sum, state.quat_d, state.goal, 0.0), Progress(state_sum, rate)


def streamed():
    """Return the loop behind streams of goals: orders say whether the spring on the quaternion as it came commands."""
    plant = BODY._replace(look=look_at_stream, advance=hold_over_tick)
    return episodes_of(plant, ACCELERATION._replace(command=follow_stream), Record(see, account_for_stream))


def with_state():
    """Return the loop of laws with a state: the world is the disturbance [rad/s^2]."""
    plant = BODY._replace(sense=sense_unit, advance=integrate)
    return episodes_of(plant, Controller(Stateful, pass_on, begin_state, command_with_state), Record(see))


LAW = types.Tuple((THREE, FOUR))(ROTATION, THREE, GOAL, GAINS, FOUR)
BEGIN = FOUR(ROTATION)


def compile_streamed():
    """Compile the loop behind streams of goals."""
    return compile_loop(streamed(), (EVALUATE,), types.NamedUniTuple(MATRIX, 2, Stream), types.boolean)


def compile_with_state():
    """Compile the loop of laws with a state."""
    return compile_loop(with_state(), (LAW, BEGIN), THREE)
