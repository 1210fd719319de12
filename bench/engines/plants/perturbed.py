"""The perturbed free body: a low rate, a delay, a goal that jumps, and the hooks of tasks/conditions.

The plant is the paper's (2.6)-(2.7) or, with an inertia that is not the model's, Euler's equations; a command holds
from tick to tick of the control, and the body is moved by steps of at most STEP_S between.
"""

import math
from typing import NamedTuple

import numpy as np

from bench.engines.arrays import Cube, Matrix, Three, Vector
from bench.engines.episode import FIRST_METRIC, Numbers
from bench.engines.ideal import angle_between, haversine, plus
from bench.engines.loop import Action, Controller, Plant, Sensed, episodes_of, sampled
from bench.engines.plants.goals import NO_BAND, restart
from bench.engines.plants.hooks import commanded, fed_forward, goal_at, inertia_of, measured
from bench.engines.plants.ideal import measure
from bench.engines.rigid_body import step
from bench.law.inputs import AT_REST, Goal
from bench.law.scalar import kernel, sqrt
from bench.law.so3 import IDENTITY, Rotation, dot, from_quaternion, minus
from bench.law.tracking import carried_along
from tasks.axis import Moment
from tasks.condition import Condition
from tasks.verdict import GOING, check_command

STEP_S = 1e-3
"""Longest step of the plant [s]."""

TAIL_S = 1.0
"""The end of an episode, over which its error is averaged [s]."""

TAIL_SQUARES, TAIL_COUNT, TAIL_WORST, VARIATION, JUMPED = range(5)
EXTRA = 5
"""Columns behind the metrics', zero at first: sum of squared angles in the tail, how many, the largest, the variation
of u, and the angle to a goal that jumps (`goals.restart`)."""


class Timing(NamedTuple):
    """A condition's times in steps of the plant.

    Attributes:
        steps: A period of the control.
        late: How late a command takes effect.
        tail: The end of an episode over which its error is averaged.
        jump: When the goal jumps; 0 for never.
        resets: Whether the law's memory is then reset.
    """

    steps: int
    late: int
    tail: int
    jump: int
    resets: bool


def timing(condition: Condition) -> Timing:
    """Return the condition's times."""
    loop, steps = condition.loop, steps_of(condition)
    step_s = loop.period_s / steps
    late, tail, jump = (round(seconds / step_s) for seconds in (loop.delay_s, TAIL_S, loop.jump_s))
    return Timing(steps, late, tail, jump, bool(loop.jump_resets))


def steps_of(condition: Condition) -> int:
    """Return the plant's steps in a control period: as few as STEP_S allows."""
    return max(1, math.ceil(condition.loop.period_s / STEP_S - 1e-9))


class PerturbedWorld(NamedTuple):
    """A condition, and what the plant reads of it.

    Attributes:
        condition: The levels of the hooks.
        timing: Its times in steps of the plant.
        inertia: Principal moments of the body over those of the law's model.
        has_moving_goal: Whether the law's command is carried along with the goal.
        is_noisy: Whether noise is drawn.
        noise: Drawn numbers, episodes x periods x 6; zeros, 1 x 1 x 6, if none are drawn.
        sent: Commands on their way, a ring.
        fresh: A row's columns from the metrics on, as they are at first.
    """

    condition: Condition
    timing: Timing
    inertia: Three
    has_moving_goal: bool
    is_noisy: bool
    noise: Cube
    sent: Matrix
    fresh: Vector


def world(condition: Condition, noise: np.ndarray, rows: np.ndarray) -> PerturbedWorld:
    """Return the world of a condition and of rows as they are at first."""
    times = timing(condition)
    return PerturbedWorld(
        condition=condition,
        timing=times,
        inertia=inertia_of(condition),
        has_moving_goal=bool(condition.acting("goal")),
        is_noisy=condition.is_noisy,
        noise=noise,
        sent=np.zeros((times.late // times.steps + 2, 3)),
        fresh=rows[0, FIRST_METRIC:].copy(),
    )


class PerturbedState(NamedTuple):
    """The body, and the goal at first; where it jumps, after the jump."""

    R: Rotation
    omega: tuple
    R_0: Rotation


class Periodic(NamedTuple):
    """Hold what a controller that runs once a period stores.

    Attributes:
        law: The law's memory.
        periods: Number of periods.
        u: The last command.
        raw: The last command as the law returned it.
        margin: Its margin.
        first: The law's memory at first.
    """

    law: tuple
    periods: int
    u: tuple
    raw: tuple
    margin: float
    first: tuple


@kernel
def reset(body, k, start):
    """Place the body at a start. Nothing is in the band of a goal that is to jump."""
    if body.timing.jump > 0:
        start[11] = NO_BAND
    R = from_quaternion((start[0], start[1], start[2], start[3]))
    R_0 = from_quaternion((start[7], start[8], start[9], start[10]))
    return PerturbedState(R, (start[4], start[5], start[6]), R_0)


@kernel
def sense(body, state, tick, numbers):
    """Give the truth; the goal has moved."""
    R, omega, R_0 = state
    held = IDENTITY if tick < body.timing.jump else R_0
    goal = goal_at(body.condition, Goal(held, AT_REST, AT_REST), tick * numbers.dt)
    behind = minus(omega, goal.omega)
    behind_squared, speed_squared = dot(behind, behind), dot(omega, omega)
    return Sensed(
        R,
        omega,
        goal,
        haversine(R, goal.R),
        behind_squared,
        speed_squared,
        behind_squared,
        GOING,
        (),
    )


@kernel
def advance(laws, body, state, action, gains, memory, numbers):
    """Move the body one step."""
    R, omega = step(state.R, state.omega, action.u, body.inertia, numbers.dt)
    return PerturbedState(R, omega, state.R_0), memory


@kernel
def begin(laws, memory0, sensed):
    """Start with the law's own memory, and no command."""
    stored = Periodic(memory0, 0, AT_REST, AT_REST, math.nan, memory0)
    return stored, Action(AT_REST, AT_REST, 0.0, math.nan, GOING, 0.0)


@kernel
def moment_of(body, sensed, now, period, numbers):
    """Return what a hook can read of the beginning of a period."""
    drawn = body.noise[now.episode, period] if body.is_noisy else body.noise[0, 0]
    noise = (drawn[0], drawn[1], drawn[2], drawn[3], drawn[4], drawn[5])
    time_s, period_s = now.number * numbers.dt, body.timing.steps * numbers.dt
    return Moment(time_s, period_s, sensed.R, sensed.omega, sensed.goal.R, noise)


@kernel
def command(laws, body, sensed, now, gains, memory, numbers):
    """Ask the law once a period, and apply what it commanded a delay ago; extra: how far this command jumps."""
    condition, timing, sent = body.condition, body.timing, body.sent
    law, periods, u, raw, margin, first = memory
    steps, slots, failure, jump = timing.steps, sent.shape[0], GOING, 0.0
    if now.number == periods * steps:
        before, goal = u, sensed.goal
        if timing.resets and 0 <= now.number - timing.jump < steps:
            law = first
        moment = moment_of(body, sensed, now, periods, numbers)
        R, omega = measured(condition, (sensed.R, sensed.omega), moment)
        rate, acceleration = fed_forward(condition, (goal.omega, goal.alpha), moment)
        raw, law, margin = laws.law(
            R, minus(omega, rate), Goal(goal.R, AT_REST, AT_REST), gains, law
        )
        u = raw
        if body.has_moving_goal:
            u = carried_along(u, omega, rate, acceleration)
        u = commanded(condition, u, moment)
        failure = check_command(dot(u, u), numbers.command_limit_squared)
        if periods > 0 and failure == GOING:
            change = plus(u, -1.0, before)
            jump = sqrt(dot(change, change))
        sent[periods % slots, 0], sent[periods % slots, 1], sent[periods % slots, 2] = u
        periods += 1
    applied = u
    if timing.late > 0 or steps > 1:
        applied = AT_REST
        if now.number >= timing.late:
            slot = ((now.number - timing.late) // steps) % slots
            applied = (sent[slot, 0], sent[slot, 1], sent[slot, 2])
    action = Action(applied, raw, dot(u, u), margin, failure, jump)
    return action, Periodic(law, periods, u, raw, margin, first)


@kernel
def account(row, body, state, sensed, action, tick, numbers):
    """Add up the errors of the tail."""
    extra = row[row.shape[0] - EXTRA :]
    if tick > numbers.ticks - body.timing.tail:
        error = angle_between(sensed.R, sensed.goal.R)
        extra[TAIL_SQUARES] += error * error
        extra[TAIL_COUNT] += 1.0
        extra[TAIL_WORST] = max(extra[TAIL_WORST], error)


def loop_of(observe):
    """Return the loop of the perturbed body, for all laws; numbers.dt is the plant's step, and ticks are such steps."""
    metrics = sampled(observe)
    show = metrics.see

    @kernel
    def see(row, curves, now, body, sensed, action, before, numbers):
        row[row.shape[0] - EXTRA + VARIATION] += action.extra
        show(row, curves, now, body, sensed, action, before, numbers)

    plant = Plant(reset, sense, advance, measure)
    return episodes_of(plant, Controller(begin, command), metrics._replace(see=see, account=account, restart=restart))


def in_steps(numbers: Numbers, condition: Condition, hold_s: float, horizon_s: float) -> Numbers:
    """Return the numbers in steps of the plant, the horizon from a goal's jump on; what lasts stops none early.

    They hold the bound of the command and the delay, which a law can read.
    """
    loop = condition.loop
    step_s = loop.period_s / steps_of(condition)
    ticks = max(1, round(horizon_s / step_s)) + timing(condition).jump
    rest = max(1, round(hold_s / step_s))
    hold = ticks + 1 if condition.lasts else rest
    return numbers._replace(
        dt=step_s,
        ticks=ticks,
        hold_ticks=hold,
        rest_ticks=rest,
        bound=loop.bound,
        delay=loop.delay_s,
    )
