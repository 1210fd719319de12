"""The loop over episodes that all engines share, made of a plant, a controller and a record.

A tick: command, see, advance, sense. What the judge sees is the state at the beginning of each tick. The parts are
kernels, which the loop holds as a closure: compiled they become one function, plain they are the reference. `body` is
the world they work in; `state`, `sensed`, `action` and `memory` go from tick to tick.

    command   calls the law, as `accelerate` does for a free body
    see       updates the metrics and the curve: the columns behind `engines.episode.FIRST_METRIC`
    advance   moves the plant over a control period
    sense     measures the plant; `watched` of the judge (tasks/verdict.py) then sees the angle

At the end `finish` of `engines.episode` asks the judge for the outcome and writes it into the row.
"""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from bench.engines.curve import keep
from bench.engines.episode import Sample, attribute_crash, finish
from bench.engines.typed import pass_by_reference
from bench.law.inputs import AT_REST, Goal, Tuning
from bench.law.scalar import kernel
from bench.law.so3 import Rotation, dot
from tasks.verdict import GOING, check_command, check_state, first_watch, watched


class Plant(NamedTuple):
    """Functions of what moves.

    Attributes:
        reset: reset(body, k, start) -> state.
        sense: sense(body, state, tick, numbers) -> Sensed.
        advance: advance(laws, body, state, action, gains, memory, numbers) -> (state, memory).
        measure: measure(body, state, sensed) -> the angle to the goal [rad].
    """

    reset: Callable
    sense: Callable
    advance: Callable
    measure: Callable


class Controller(NamedTuple):
    """Functions of what commands.

    Attributes:
        begin: begin(laws, memory0, sensed) -> (memory, action before the first).
        command: command(laws, body, sensed, now, gains, memory, numbers) -> (action, memory), where
            now is an EpisodeTick.
    """

    begin: Callable
    command: Callable


class Laws(NamedTuple):
    """What the loop calls by pointer: the law, and two functions more if its controller has them."""

    law: Any
    second: Any
    third: Any


class Sensed(NamedTuple):
    """What is known of the plant at a tick, base frame.

    Attributes:
        R: Orientation.
        omega: Angular velocity [rad/s].
        goal: Goal of the law.
        haversine: sin^2(angle/2) of the angle to the goal.
        watched_speed_squared: Square of the speed by which the judge's watch tells what is slow.
        limited_speed_squared: Square of the speed that the judge limits.
        rest_speed_squared: Square of the speed that must be small at the end.
        ended_by: Why the plant ends the episode, or GOING.
        extra: What is particular to a plant.
    """

    R: Rotation
    omega: tuple
    goal: Goal
    haversine: float
    watched_speed_squared: float
    limited_speed_squared: float
    rest_speed_squared: float
    ended_by: int
    extra: Any


class Action(NamedTuple):
    """A command.

    Attributes:
        u: The command as it is applied.
        raw: The command as the law returned it.
        squared: The square of the command that the verdict takes.
        margin: Margin of the representation; NaN for a law on R.
        failure: Why the command ends the episode, or GOING.
        extra: What is particular to a controller.
    """

    u: tuple
    raw: tuple
    squared: float
    margin: float
    failure: int
    extra: Any = ()


NO_ACTION = Action(AT_REST, AT_REST, 0.0, math.nan, GOING)


class EpisodeTick(NamedTuple):
    """A tick of an episode.

    Attributes:
        episode: Number of the episode.
        number: Number of the tick.
        entered: Whether the judge has seen the angle in the band.
        at_rest: Whether the judge has seen the body in the band and slow.
    """

    episode: int
    number: int
    entered: bool
    at_rest: bool


@kernel
def begin(laws, memory0, sensed):
    """Start with the law's own memory, and no command."""
    return memory0, NO_ACTION


@kernel
def accelerate(laws, body, sensed, now, gains, memory, numbers):
    """Command the angular acceleration that the law says."""
    u, memory, margin = laws.law(sensed.R, sensed.omega, sensed.goal, gains, memory)
    squared = dot(u, u)
    return Action(
        u, u, squared, margin, check_command(squared, numbers.command_limit_squared), ()
    ), memory


ACCELERATION = Controller(begin, accelerate)


class Record(NamedTuple):
    """Functions that fill a row; the last three may be missing.

    see(row, curves, now, body, sensed, action, before, numbers): before the plant moves; before: the u before this one.
    account(row, body, state, sensed, action, tick, numbers): after it has. close(row, body, state, k, numbers): at the
    end. restart(row, start, body, sensed, tick): before the judge sees a tick; may begin the row and the band again.
    """

    see: Callable
    account: Callable | None = None
    close: Callable | None = None
    restart: Callable | None = None


def sampled(observe) -> Record:
    """Return the record of a free body: the metrics' columns, and curves."""

    @kernel
    def see(row, curves, now, body, sensed, action, before, numbers):
        time, R, hav, omega = now.number * numbers.dt, sensed.R, sensed.haversine, sensed.omega
        sample = Sample(
            time,
            numbers.dt,
            R,
            hav,
            now.entered,
            now.at_rest,
            omega,
            action.u,
            before,
            action.margin,
        )
        observe(row, sample)
        keep(curves, now.episode, now.number, sample)

    return Record(see)


def episodes_of(plant: Plant, controller: Controller, record: Record):
    """Return the loop, which fills the last two of its arguments: a row an episode, and curves where there is room."""
    reset, sense, advance, measure = plant
    begin, command = controller
    see, account, close, restart = record

    def episodes(first, second, third, world, memory0, starts, numbers, rows, curves):
        laws, body = Laws(first, second, third), pass_by_reference(world)
        gains = Tuning(numbers.kp, numbers.kv, numbers.bound, numbers.delay)
        for k in range(starts.shape[0]):
            start, row = starts[k], rows[k]
            state = reset(body, k, start)
            sensed = sense(body, state, 0, numbers)
            watch = first_watch(
                sensed.haversine, start[11], sensed.watched_speed_squared, numbers.slow_squared
            )
            memory, action = begin(laws, memory0, sensed)
            tick, failure = 0, sensed.ended_by
            while tick < numbers.ticks and watch.quiet < numbers.hold_ticks and failure == GOING:
                before, now = action.u, EpisodeTick(k, tick, watch.entries > 0, watch.rest > 0)
                action, memory = command(laws, body, sensed, now, gains, memory, numbers)
                see(row, curves, now, body, sensed, action, before, numbers)
                failure = action.failure
                if failure != GOING:
                    break
                state, memory = advance(laws, body, state, action, gains, memory, numbers)
                tick += 1
                sensed = sense(body, state, tick, numbers)
                failure = sensed.ended_by
                if failure == GOING:
                    failure = check_state(sensed.limited_speed_squared, numbers.speed_limit_squared)
                if failure != GOING:
                    break
                if restart is not None:
                    restart(row, start, body, sensed, tick)
                watched_speed_squared = sensed.watched_speed_squared
                watch = watched(
                    watch,
                    tick,
                    sensed.haversine,
                    start[11],
                    watched_speed_squared,
                    numbers.slow_squared,
                )
                if account is not None:
                    account(row, body, state, sensed, action, tick, numbers)
            angle = measure(body, state, sensed)
            failure = attribute_crash(failure, action.raw)
            finish(
                row, failure, watch, tick, angle, sensed.rest_speed_squared, action.squared, numbers
            )
            if close is not None:
                close(row, body, state, k, numbers)

    return episodes
