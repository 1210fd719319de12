"""The perturbed free body (tasks/condition.py): a low rate, delay, noise, saturation, model errors, moving goals.

The plant is the paper's (2.6)-(2.7) or, with an inertia that is not the model's, Euler's equations; a command holds
from tick to tick of the control, and the body is moved by steps of at most STEP_S between.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from bench.engines.compiled import THREE, float64, int64, types
from bench.engines.controllers import Law
from bench.engines.episode import FIRST_METRIC, Numbers
from bench.engines.ideal import angle_between, haversine, plus, turned
from bench.engines.loop import Controller, Plant, episodes_of, pass_on, sampled
from bench.engines.rigid_body import bounded, step
from bench.law.contender import AT_REST, Goal
from bench.law.scalar import kernel, sqrt
from bench.law.so3 import Rotation, dot, from_quaternion, minus, turn_quaternion
from bench.law.tracking import carried_along
from tasks.condition import RATE, RATE_AND_ACCELERATION, Condition
from tasks.moving_goal import reference_column, reference_rates
from tasks.verdict import GOING, check_command, check_state

STEP_S = 1e-3
"""Longest step of the plant [s]."""

TAIL_S = 1.0
"""The end of an episode, over which its error is averaged [s]."""

LEAD = 2.0
"""Periods that the worst of measurements looks ahead."""

TAIL_SQUARES, TAIL_COUNT, TAIL_WORST, VARIATION = range(4)
EXTRA = 4
"""Columns behind the metrics': sum of squared angles in the tail, how many, the largest, and the variation of u."""


class Timing(NamedTuple):
    """A condition's times in steps of the plant: a period of control, how late a command is, the tail."""

    steps: int
    late: int
    tail: int


def timing(condition: Condition) -> Timing:
    """The condition's times."""
    steps = steps_of(condition)
    step_s = condition.period_s / steps
    return Timing(steps, round(condition.delay_s / step_s), round(TAIL_S / step_s))


def steps_of(condition: Condition) -> int:
    """Steps of the plant in a period of control: as few as STEP_S allows."""
    return max(1, math.ceil(condition.period_s / STEP_S - 1e-9))


@kernel
def reported(R, omega, R_d, noise, condition, ahead):
    """(R, omega) as they are measured: turned and shifted by drawn numbers, and by the worst that can be at half turns.

    The worst is reported with foresight: away from the goal as it will be in LEAD periods, so that what turns back the
    body brakes it too. Without, the body swings through the half turn farther each time, and gets away.

    Args:
        noise: six numbers, of unit standard deviation. ahead: LEAD periods [s].
    """
    if condition.attitude_noise > 0.0:
        s = condition.attitude_noise
        R = turned(R, (s * noise[0], s * noise[1], s * noise[2]))
    if condition.rate_noise > 0.0:
        omega = plus(omega, condition.rate_noise, (noise[3], noise[4], noise[5]))
    if condition.worst_attitude_error > 0.0 and angle_between(R, R_d) + condition.worst_attitude_error > math.pi:
        _, v, _ = turn_quaternion(turned(R, (ahead * omega[0], ahead * omega[1], ahead * omega[2])), R_d)
        away = -condition.worst_attitude_error / sqrt(dot(v, v))
        R = turned(R, (away * v[0], away * v[1], away * v[2]))
    return R, omega


@kernel
def goal_at(R_0, time, amplitude):
    """(R_d, omega_d, alpha_d) at a time."""
    if amplitude > 0.0:
        R_d = Rotation(
            reference_column(time, amplitude, R_0.n),
            reference_column(time, amplitude, R_0.o),
            reference_column(time, amplitude, R_0.a),
        )
        omega_d, alpha_d = reference_rates(time, amplitude)
        return R_d, omega_d, alpha_d
    return R_0, AT_REST, AT_REST


@kernel
def fed_forward(omega_d, alpha_d, feedforward):
    """What the law is given of the goal's motion."""
    if feedforward < RATE:
        return AT_REST, AT_REST
    if feedforward < RATE_AND_ACCELERATION:
        return omega_d, AT_REST
    return omega_d, alpha_d


class World(NamedTuple):
    """A condition, its times, noise (episodes x periods x six, read only if there is noise), and room for commands."""

    condition: Condition
    timing: Timing
    noise: Any
    sent: Any


TIMING = types.NamedUniTuple(int64, len(Timing._fields), Timing)
CONDITION = types.NamedTuple((*[float64] * 6, THREE, float64, int64, float64), Condition)
WORLD = types.NamedTuple((CONDITION, TIMING, float64[:, :, ::1], float64[:, ::1]), World)


def world(condition: Condition, noise: np.ndarray) -> World:
    """Return the world of a condition: commands on their way are kept in a ring."""
    times = timing(condition)
    return World(condition, times, noise, np.zeros((times.late // times.steps + 2, 3)))


class State(NamedTuple):
    """The body, and the goal at first and now with its angular velocity and acceleration."""

    R: Rotation
    omega: tuple
    R_0: Rotation
    R_d: Rotation
    omega_d: tuple
    alpha_d: tuple


class Periodic(NamedTuple):
    """What a controller that is asked once a period remembers: number of periods, the last command, as it was given."""

    law: tuple
    periods: int
    u: tuple
    given: tuple
    margin: float


class LateAct(NamedTuple):
    """`loop.Act` of a command that comes late; jump: by how much this tick's differs from that before, or 0."""

    u: tuple
    given: tuple
    squared: float
    margin: float
    failure: int
    jump: float


NO_ACT = LateAct(AT_REST, AT_REST, 0.0, math.nan, GOING, 0.0)


@kernel
def reset(body, k, start):
    """Place the body at a start."""
    R = from_quaternion((start[0], start[1], start[2], start[3]))
    R_0 = from_quaternion((start[7], start[8], start[9], start[10]))
    return State(R, (start[4], start[5], start[6]), R_0, R_0, AT_REST, AT_REST)


@kernel
def sense(body, state):
    """Give the truth; what is measured is `reported`."""
    return state


@kernel
def look(body, state, tick, numbers):
    """Move the goal, and compare the body with it."""
    R_d, omega_d, alpha_d = goal_at(state.R_0, tick * numbers.dt, body.condition.reference_amplitude)
    speed = minus(state.omega, omega_d)
    seen = State(state.R, state.omega, state.R_0, R_d, omega_d, alpha_d)
    return seen, haversine(state.R, R_d), dot(speed, speed)


@kernel
def advance(laws, body, desk, state, act, gains, memory, numbers):
    """Move the body one step."""
    R, omega = step(state.R, state.omega, act.u, body.condition.inertia, numbers.dt)
    return State(R, omega, state.R_0, state.R_d, state.omega_d, state.alpha_d), memory


@kernel
def check(body, state, numbers):
    """End an episode that diverges."""
    return check_state(dot(state.omega, state.omega), numbers.speed_limit_squared)


@kernel
def end(body, state):
    """Measure the last angle and speed against the goal's."""
    speed = minus(state.omega, state.omega_d)
    return angle_between(state.R, state.R_d), dot(speed, speed)


@kernel
def begin(laws, memory0, sensed):
    """Start with the law's own memory, and no command."""
    return Periodic(memory0, 0, AT_REST, AT_REST, math.nan), NO_ACT


@kernel
def command(laws, body, desk, state, sensed, now, gains, memory, numbers):
    """Ask the law once a period, and apply what it commanded a delay ago."""
    condition, timing, sent = body.condition, body.timing, body.sent
    law, periods, u, given, margin = memory
    steps, slots, failure, jump = timing.steps, sent.shape[0], GOING, 0.0
    if now.tick == periods * steps:
        is_noisy = condition.attitude_noise > 0.0 or condition.rate_noise > 0.0
        noise = body.noise[now.k, periods] if is_noisy else body.noise[0, 0]
        R, turning = reported(sensed.R, sensed.omega, sensed.R_d, noise, condition, LEAD * (steps * numbers.dt))
        rate, acceleration = fed_forward(sensed.omega_d, sensed.alpha_d, condition.feedforward)
        goal = Goal(sensed.R_d, AT_REST, AT_REST)
        before = u
        given, law, margin = laws.evaluate(R, minus(turning, rate), goal, gains, law)
        u = given
        if condition.reference_amplitude > 0.0:
            u = carried_along(u, turning, rate, acceleration)
        u = bounded(u, condition.bound)
        failure = check_command(dot(u, u), numbers.command_limit_squared)
        if periods > 0 and failure == GOING:
            change = plus(u, -1.0, before)
            jump = sqrt(dot(change, change))
        sent[periods % slots, 0], sent[periods % slots, 1], sent[periods % slots, 2] = u
        periods += 1
    applied = u
    if timing.late > 0 or steps > 1:
        applied = AT_REST
        if now.tick >= timing.late:
            slot = ((now.tick - timing.late) // steps) % slots
            applied = (sent[slot, 0], sent[slot, 1], sent[slot, 2])
    return LateAct(applied, given, dot(u, u), margin, failure, jump), Periodic(law, periods, u, given, margin)


@kernel
def account(row, body, desk, state, act, tick, numbers):
    """Add up the errors of the tail."""
    extra = row[row.shape[0] - EXTRA :]
    if tick > numbers.ticks - body.timing.tail:
        error = angle_between(state.R, state.R_d)
        extra[TAIL_SQUARES] += error * error
        extra[TAIL_COUNT] += 1.0
        extra[TAIL_WORST] = max(extra[TAIL_WORST], error)


def loop_of(observe):
    """Return the loop of the perturbed body, for all laws; numbers.dt is the plant's step, and ticks are such steps."""
    metrics = sampled(observe)

    @kernel
    def see(row, curves, now, body, desk, state, sensed, act, before, numbers):
        row[row.shape[0] - EXTRA + VARIATION] += act.jump
        metrics_see(row, curves, now, body, desk, state, sensed, act, before, numbers)

    metrics_see = metrics.see
    plant = Plant(pass_on, reset, sense, look, advance, check, end)
    return episodes_of(plant, Controller(Law, pass_on, begin, command), metrics._replace(see=see, account=account))


def blank_rows(count: int, metrics) -> np.ndarray:
    """Rows to be filled: every metric at its start value."""
    rows = np.zeros((count, FIRST_METRIC + len(metrics) + EXTRA))
    rows[:, FIRST_METRIC : FIRST_METRIC + len(metrics)] = [metric.start for metric in metrics]
    return rows


def in_steps(numbers: Numbers, condition: Condition, hold_s: float, horizon_s: float) -> Numbers:
    """The numbers with the plant's step for a tick; no episode stops early under a perturbation that lasts."""
    step_s = condition.period_s / steps_of(condition)
    ticks = max(1, round(horizon_s / step_s))
    rest = max(1, round(hold_s / step_s))
    hold = ticks + 1 if condition.lasts else rest
    return numbers._replace(dt=step_s, ticks=ticks, hold_ticks=hold, rest_ticks=rest)
