"""The loop over episodes that all engines share, made of a plant, a controller and a record.

A tick: command, see, advance, sense. What the judge sees is the state at the beginning of each tick. The parts are
kernels, which the loop holds as a closure: compiled they become one function, plain they are the reference. `body` is
the world they work in; `state`, `sensed`, `act` and `memory` go from tick to tick.
"""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from bench.engines.curve import keep
from bench.engines.episode import Sample, blamed, finish
from bench.engines.typed import borrow
from bench.law.inputs import AT_REST, Goal, Tuning
from bench.law.scalar import kernel
from bench.law.so3 import Rotation, dot
from tasks.verdict import GOING, check_command, check_state, first_watch, watched


class Plant(NamedTuple):
    """Functions of what moves.

    reset(body, k, start) -> state; sense(body, state, tick, numbers) -> Sensed; advance(laws, body, state, act, gains,
    memory, numbers) -> (state, memory); measure(body, state, sensed) -> the angle to the goal [rad].
    """

    reset: Callable
    sense: Callable
    advance: Callable
    measure: Callable


class Controller(NamedTuple):
    """Functions of what commands.

    begin(laws, memory0, sensed) -> (memory, act before the first); command(laws, body, sensed, now, gains, memory,
    numbers) -> (act, memory).
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

    turning, speed, rest: squared speeds, as the judge's watch, his limit and his verdict take them. fate: why the plant
    ends the episode, or GOING. more: what is particular to a plant.
    """

    R: Rotation
    omega: tuple
    goal: Goal
    haversine: float
    turning: float
    speed: float
    rest: float
    fate: int
    more: Any


class Act(NamedTuple):
    """A command: u as it is applied and as the law gave it, its square for the verdict, margin, and why it fails.

    more: what is particular to a controller.
    """

    u: tuple
    given: tuple
    squared: float
    margin: float
    failure: int
    more: Any = ()


NO_ACT = Act(AT_REST, AT_REST, 0.0, math.nan, GOING)


class Now(NamedTuple):
    """Number of the episode and of the tick; whether the judge has seen the angle in the band, and the body at rest."""

    k: int
    tick: int
    entered: bool
    at_rest: bool


@kernel
def begin(laws, memory0, sensed):
    """Start with the law's own memory, and no command."""
    return memory0, NO_ACT


@kernel
def accelerate(laws, body, sensed, now, gains, memory, numbers):
    """Command the angular acceleration that the law says."""
    u, memory, margin = laws.law(sensed.R, sensed.omega, sensed.goal, gains, memory)
    squared = dot(u, u)
    return Act(u, u, squared, margin, check_command(squared, numbers.command_limit_squared), ()), memory


ACCELERATION = Controller(begin, accelerate)


class Record(NamedTuple):
    """Functions that fill a row; the last three may be missing.

    see(row, curves, now, body, sensed, act, before, numbers): before the plant moves; before: the u before this one.
    account(row, body, state, sensed, act, tick, numbers): after it has. close(row, body, state, k, numbers): at the
    end. restart(row, start, body, sensed, tick): before the judge sees a tick; may begin the row and the band again.
    """

    see: Callable
    account: Callable | None = None
    close: Callable | None = None
    restart: Callable | None = None


def sampled(observe) -> Record:
    """Return the record of a free body: the metrics' columns, and curves."""

    @kernel
    def see(row, curves, now, body, sensed, act, before, numbers):
        time, R, hav, omega = now.tick * numbers.dt, sensed.R, sensed.haversine, sensed.omega
        sample = Sample(time, numbers.dt, R, hav, now.entered, now.at_rest, omega, act.u, before, act.margin)
        observe(row, sample)
        keep(curves, now.k, now.tick, sample)

    return Record(see)


def episodes_of(plant: Plant, controller: Controller, record: Record):
    """Return the loop, which fills the last two of its arguments: a row an episode, and curves where there is room."""
    reset, sense, advance, measure = plant
    begin, command = controller
    see, account, close, restart = record

    def episodes(first, second, third, world, memory0, starts, numbers, rows, curves):
        laws, body = Laws(first, second, third), borrow(world)
        gains = Tuning(numbers.kp, numbers.kv, numbers.bound, numbers.delay)
        for k in range(starts.shape[0]):
            start, row = starts[k], rows[k]
            state = reset(body, k, start)
            sensed = sense(body, state, 0, numbers)
            watch = first_watch(sensed.haversine, start[11], sensed.turning, numbers.slow_squared)
            memory, act = begin(laws, memory0, sensed)
            tick, failure = 0, sensed.fate
            while tick < numbers.ticks and watch.quiet < numbers.hold_ticks and failure == GOING:
                before, now = act.u, Now(k, tick, watch.entries > 0, watch.rest > 0)
                act, memory = command(laws, body, sensed, now, gains, memory, numbers)
                see(row, curves, now, body, sensed, act, before, numbers)
                failure = act.failure
                if failure != GOING:
                    break
                state, memory = advance(laws, body, state, act, gains, memory, numbers)
                tick += 1
                sensed = sense(body, state, tick, numbers)
                failure = sensed.fate
                if failure == GOING:
                    failure = check_state(sensed.speed, numbers.speed_limit_squared)
                if failure != GOING:
                    break
                if restart is not None:
                    restart(row, start, body, sensed, tick)
                watch = watched(watch, tick, sensed.haversine, start[11], sensed.turning, numbers.slow_squared)
                if account is not None:
                    account(row, body, state, sensed, act, tick, numbers)
            angle, failure = measure(body, state, sensed), blamed(failure, act.given)
            finish(row, failure, watch, tick, angle, sensed.rest, act.squared, numbers)
            if close is not None:
                close(row, body, state, k, numbers)

    return episodes
