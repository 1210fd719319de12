"""The loop over episodes that all engines share, made of a plant, a controller and a record.

A tick: sense, command, see | advance, check | look. What the judge sees is the state at the beginning of each tick.
The parts are kernels, which the loop holds as a closure: compiled they become one function, plain they are the
reference. `body` and `desk` are what plant and controller work with; `state`, `memory` and `act` go from tick to tick.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

from bench.engines.curve import keep
from bench.engines.episode import Sample, blamed, finish
from bench.law.contender import AT_REST, Gains
from bench.law.scalar import kernel
from tasks.verdict import GOING, first_watch, watched


class Plant(NamedTuple):
    """Functions of what moves.

    enter(world) -> body, what all episodes share; reset(body, k, start) -> state; sense(body, state) -> what a
    controller and a record are given, R and omega among it; look(body, state, tick, numbers) -> (state, haversine,
    speed squared), the judge's look, after which goals that move have moved; advance(laws, body, desk, state, act,
    gains, memory, numbers) -> (state, memory); check(body, state, numbers) -> why the episode ends, or GOING;
    end(body, state) -> (angle, speed squared).
    """

    enter: Callable
    reset: Callable
    sense: Callable
    look: Callable
    advance: Callable
    check: Callable
    end: Callable


class Controller(NamedTuple):
    """Functions of what commands.

    gather(first, second, third) -> the law's functions by their names; ready(orders) -> desk; begin(laws, memory0,
    sensed) -> (memory, act); command(laws, body, desk, state, sensed, now, gains, memory, numbers) -> (act, memory).
    """

    gather: Callable
    ready: Callable
    begin: Callable
    command: Callable


class Act(NamedTuple):
    """A command: u as applied and as the law gave it, its square for the verdict, the margin, and why it fails."""

    u: tuple
    given: tuple
    squared: float
    margin: float
    failure: int


NO_ACT = Act(AT_REST, AT_REST, 0.0, math.nan, GOING)


class Now(NamedTuple):
    """Number of the episode and of the tick; what the judge has seen of it."""

    k: int
    tick: int
    haversine: float
    entered: bool
    at_rest: bool


@kernel
def pass_on(given):
    """Return what is given: a world that is a body already, or orders that are a desk."""
    return given


@kernel
def no_account(row, body, desk, state, act, tick, numbers):
    """Keep nothing of a tick that is over."""
    return None


@kernel
def no_close(row, body, desk, state, k, numbers):
    """Add nothing to an episode's row."""
    return None


class Record(NamedTuple):
    """Functions that fill a row.

    see(row, curves, now, body, desk, state, sensed, act, before, numbers): before the plant moves, with the command
    before it. account(row, body, desk, state, act, tick, numbers): after it has. close(row, body, desk, state, k,
    numbers): at the end.
    """

    see: Callable
    account: Callable = no_account
    close: Callable = no_close


def sampled(observe) -> Record:
    """Return the record of a free body: the metrics' columns, and curves."""

    @kernel
    def see(row, curves, now, body, desk, state, sensed, act, before, numbers):
        dt = numbers.dt
        sample = Sample(
            now.tick * dt, dt, sensed.R, now.haversine, now.entered, now.at_rest, sensed.omega,
            act.u, before, act.margin,
        )  # fmt: skip
        observe(row, sample)
        keep(curves, now.k, now.tick, sample)

    return Record(see)


def episodes_of(plant: Plant, controller: Controller, record: Record):
    """Return the loop, which fills the last two of its arguments: a row an episode, and curves where there is room."""
    enter, reset, sense, look, advance, check, end = plant
    gather, ready, begin, command = controller
    see, account, close = record

    def episodes(first, second, third, world, orders, memory0, starts, numbers, rows, curves):
        laws, gains = gather(first, second, third), Gains(numbers.kp, numbers.kv)
        body, desk = enter(world), ready(orders)
        for k in range(starts.shape[0]):
            start, row = starts[k], rows[k]
            state, haversine, speed = look(body, reset(body, k, start), 0, numbers)
            watch = first_watch(haversine, start[11], speed, numbers.slow_squared)
            memory, act = begin(laws, memory0, sense(body, state))
            tick, failure = 0, GOING
            while tick < numbers.ticks and watch.quiet < numbers.hold_ticks:
                sensed, before = sense(body, state), act.u
                now = Now(k, tick, haversine, watch.entries > 0, watch.rest > 0)
                act, memory = command(laws, body, desk, state, sensed, now, gains, memory, numbers)
                see(row, curves, now, body, desk, state, sensed, act, before, numbers)
                failure = act.failure
                if failure != GOING:
                    break
                state, memory = advance(laws, body, desk, state, act, gains, memory, numbers)
                tick += 1
                failure = check(body, state, numbers)
                if failure != GOING:
                    break
                state, haversine, speed = look(body, state, tick, numbers)
                watch = watched(watch, tick, haversine, start[11], speed, numbers.slow_squared)
                account(row, body, desk, state, act, tick, numbers)
            angle, speed = end(body, state)
            finish(row, blamed(failure, act.given), watch, tick, angle, speed, act.squared, numbers)
            close(row, body, desk, state, k, numbers)

    return episodes
