"""The perturbed free body (tasks/condition.py): a low rate, delay, noise, saturation, model errors, moving goals.

The plant is the paper's (2.6)-(2.7) or, with an inertia that is not the model's, Euler's equations; a command holds
from tick to tick of the control, and the body is moved by steps of at most STEP_S between.
"""

import math
from typing import NamedTuple

import numpy as np
from numba import float64, int64, types

from bench.engines.compiled import EVALUATE, FOUR, MATRIX, NUMBERS, THREE, compile_function
from bench.engines.episode import FIRST_METRIC, Numbers, Sample, blamed, finish
from bench.engines.ideal import angle_between, haversine, plus, turned
from bench.engines.rigid_body import bounded, step
from bench.law.contender import AT_REST, Gains, Goal
from bench.law.scalar import kernel, sqrt
from bench.law.so3 import Rotation, dot, from_quaternion, minus, turn_quaternion
from bench.law.tracking import carried_along
from tasks.condition import FIELDS, RATE, RATE_AND_ACCELERATION, Condition
from tasks.moving_goal import reference_column, reference_rates
from tasks.verdict import GOING, check_command, check_state, first_watch, watched

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


TIMING = types.NamedUniTuple(int64, len(Timing._fields), Timing)
TYPES = {float: float64, int: int64, tuple: THREE}
CONDITION = types.NamedTuple([TYPES[type(one.default)] for one in FIELDS], Condition)
NOISE = float64[:, :, ::1]
EPISODES = types.void(types.FunctionType(EVALUATE), FOUR, MATRIX, NOISE, NUMBERS, TIMING, CONDITION, MATRIX)


def episodes_of(observe):
    """The loop over episodes, for all laws: `episodes(evaluate, memory0, starts, noise, numbers, ..., rows)`.

    numbers.dt is the plant's step, and ticks are such steps; noise: episodes x periods x six, read only if there is
    noise. The rows are filled: the judge's columns, the metrics', and EXTRA more.
    """

    def episodes(evaluate, memory0, starts, noise, numbers, timing, condition, rows):
        gains = Gains(numbers.kp, numbers.kv)
        h = numbers.dt
        is_noisy = condition.attitude_noise > 0.0 or condition.rate_noise > 0.0
        is_prompt = timing.late == 0 and timing.steps == 1
        slots = timing.late // timing.steps + 2
        sent = np.zeros((slots, 3))
        for k in range(starts.shape[0]):
            start, row = starts[k], rows[k]
            extra = row[row.shape[0] - EXTRA :]
            R = from_quaternion((start[0], start[1], start[2], start[3]))
            omega = (start[4], start[5], start[6])
            R_0 = from_quaternion((start[7], start[8], start[9], start[10]))
            R_d, omega_d, alpha_d = goal_at(R_0, 0.0, condition.reference_amplitude)
            band = start[11]
            memory, margin = memory0, math.nan
            u = given = applied = AT_REST
            hav = haversine(R, R_d)
            speed = minus(omega, omega_d)
            watch = first_watch(hav, band, dot(speed, speed), numbers.slow_squared)
            tick, period = 0, 0
            failure = GOING
            while tick < numbers.ticks and watch.quiet < numbers.hold_ticks:
                if tick == period * timing.steps:
                    before = u
                    drawn = noise[k, period] if is_noisy else noise[0, 0]
                    seen, turning = reported(R, omega, R_d, drawn, condition, LEAD * (timing.steps * h))
                    rate, acceleration = fed_forward(omega_d, alpha_d, condition.feedforward)
                    goal = Goal(R_d, AT_REST, AT_REST)
                    given, memory, margin = evaluate(seen, minus(turning, rate), goal, gains, memory)
                    u = given
                    if condition.reference_amplitude > 0.0:
                        u = carried_along(u, turning, rate, acceleration)
                    u = bounded(u, condition.bound)
                    failure = check_command(dot(u, u), numbers.command_limit_squared)
                    if period > 0 and failure == GOING:
                        jump = plus(u, -1.0, before)
                        extra[VARIATION] += sqrt(dot(jump, jump))
                    sent[period % slots, 0], sent[period % slots, 1], sent[period % slots, 2] = u
                    period += 1
                last, applied = applied, u
                if not is_prompt:
                    applied = AT_REST
                    if tick >= timing.late:
                        slot = ((tick - timing.late) // timing.steps) % slots
                        applied = (sent[slot, 0], sent[slot, 1], sent[slot, 2])
                entered, at_rest = watch.entries > 0, watch.rest > 0
                observe(row, Sample(tick * h, h, R, hav, entered, at_rest, omega, applied, last, margin))
                if failure != GOING:
                    break
                R, omega = step(R, omega, applied, condition.inertia, h)
                tick += 1
                failure = check_state(dot(omega, omega), numbers.speed_limit_squared)
                if failure != GOING:
                    break
                R_d, omega_d, alpha_d = goal_at(R_0, tick * h, condition.reference_amplitude)
                hav = haversine(R, R_d)
                speed = minus(omega, omega_d)
                watch = watched(watch, tick, hav, band, dot(speed, speed), numbers.slow_squared)
                if tick > numbers.ticks - timing.tail:
                    error = angle_between(R, R_d)
                    extra[TAIL_SQUARES] += error * error
                    extra[TAIL_COUNT] += 1.0
                    extra[TAIL_WORST] = max(extra[TAIL_WORST], error)
            speed = minus(omega, omega_d)
            final = angle_between(R, R_d)
            failure = blamed(failure, given)
            finish(row, failure, watch, tick, final, dot(speed, speed), dot(u, u), numbers)

    return episodes


def compiled(observe):
    """The same, compiled."""
    return compile_function(episodes_of(observe), EPISODES)


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
