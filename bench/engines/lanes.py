"""The ideal plant on many starts at once: the episodes of `ideal`, bit for bit, in a fraction of its time.

LANES episodes are in work side by side, each number of theirs a row of a buffer, so that the compiler makes one vector
instruction of as many lanes as the processor takes. For that a law is compiled into the loop, with all that it calls:
seconds a law and an engine, which some 10^5 episodes are worth. What a law asks of libm is asked lane by lane.

CPU time of a tick over that of `ideal`, medians of 2026 on AVX-512: laws without libm 0.13 to 0.17 (held) and 0.11 to
0.15 (RK4), with AVX2 0.24; with an arc 0.3; Euler angles 0.45 to 0.8.

An episode that ends gives its lane to the next start; when there is none, to the last lane in work.
"""

import numpy as np
from numba import types

from bench.engines import ideal
from bench.engines.compiled import FOUR, MATRIX, NUMBERS, compile_function
from bench.engines.episode import FIRST_METRIC, Sample, attribute_crash, finish
from bench.law.inputs import AT_REST, Goal, Tuning
from bench.law.scalar import kernel
from bench.law.so3 import Rotation, dot, from_quaternion
from tasks.verdict import GOING, Watch, check_command, check_state, first_watch, watched

LANES = 64
"""Lanes of a block: of 8 the compiler would make straight code, which is not faster than one start at a time."""

VECTOR = 8
"""Lanes that one instruction takes at most: a number of lanes that it divides leaves none to be done one by one."""

(R, OMEGA, R_D, MEMORY, U, HAVERSINE, BAND, FIRST, SECOND, REALS) = (0, 9, 12, 21, 25, 28, 29, 30, 31, 32)
"""Rows of a lane's real numbers: where each begins, and how many there are."""

(ENTRIES, SETTLED_SINCE, SLOW, REST, QUIET, TICK, FAILURE, ENDED, EPISODE, INTEGERS) = range(10)
"""Rows of its whole numbers."""

NONE = -1
"""The episode of a lane that has none, or whose row is written."""


@kernel
def three(x, row, i):
    """Return a vector of lane i."""
    return (x[row, i], x[row + 1, i], x[row + 2, i])


@kernel
def set_three(x, row, i, v):
    """Store one."""
    x[row, i], x[row + 1, i], x[row + 2, i] = v[0], v[1], v[2]


@kernel
def memory_at(x, i):
    """Return the law's memory."""
    return (x[MEMORY, i], x[MEMORY + 1, i], x[MEMORY + 2, i], x[MEMORY + 3, i])


@kernel
def set_memory(x, i, memory):
    """Store it."""
    set_three(x, MEMORY, i, memory)
    x[MEMORY + 3, i] = memory[3]


@kernel
def rotation(x, row, i):
    """Return a rotation of lane i."""
    return Rotation(three(x, row, i), three(x, row + 3, i), three(x, row + 6, i))


@kernel
def set_state(x, i, at, omega, hav):
    """Store where lane i is."""
    set_three(x, R, i, at.n)
    set_three(x, R + 3, i, at.o)
    set_three(x, R + 6, i, at.a)
    set_three(x, OMEGA, i, omega)
    x[HAVERSINE, i] = hav


@kernel
def watch_of(n, i):
    """Return what the judge remembers of lane i."""
    return Watch(n[ENTRIES, i], n[SETTLED_SINCE, i], n[SLOW, i] > 0, n[REST, i], n[QUIET, i])


@kernel
def set_watch(n, i, watch, tick, failure, numbers):
    """Store it, and whether the episode has ended."""
    n[ENTRIES, i], n[SETTLED_SINCE, i], n[SLOW, i] = watch.entries, watch.settled_since, watch.slow
    n[REST, i], n[QUIET, i], n[TICK, i], n[FAILURE, i] = watch.rest, watch.quiet, tick, failure
    has_ended = (failure != GOING) | (tick >= numbers.ticks) | (watch.quiet >= numbers.hold_ticks)
    n[ENDED, i] = has_ended | (n[EPISODE, i] == NONE)


@kernel
def begin(x, n, i, k, start, memory0, numbers):
    """Put start k on lane i."""
    at = from_quaternion((start[0], start[1], start[2], start[3]))
    omega = (start[4], start[5], start[6])
    R_d = from_quaternion((start[7], start[8], start[9], start[10]))
    hav = ideal.haversine(at, R_d)
    set_state(x, i, at, omega, hav)
    set_three(x, R_D, i, R_d.n)
    set_three(x, R_D + 3, i, R_d.o)
    set_three(x, R_D + 6, i, R_d.a)
    set_memory(x, i, memory0)
    set_three(x, U, i, AT_REST)
    x[BAND, i] = start[11]
    n[EPISODE, i] = k
    set_watch(n, i, first_watch(hav, start[11], dot(omega, omega), numbers.slow_squared), 0, GOING, numbers)


@kernel
def end(x, n, i, row, measured, numbers):
    """Write the row of the episode on lane i."""
    omega, u = three(x, OMEGA, i), three(x, U, i)
    angle, failure = (
        ideal.angle_between(rotation(x, R, i), rotation(x, R_D, i)),
        attribute_crash(n[FAILURE, i], u),
    )
    finish(row, failure, watch_of(n, i), n[TICK, i], angle, dot(omega, omega), dot(u, u), numbers)
    for column in range(FIRST_METRIC, len(row)):
        row[column] = measured[column, i]
    n[EPISODE, i] = NONE


@kernel
def copy(numbers, i, j):
    """Lane i becomes lane j."""
    for row in range(len(numbers)):
        numbers[row, i] = numbers[row, j]


@kernel
def _series(x, lanes, dt):
    """Compute the two coefficients of each lane's rotation: by series, and of large rotations one by one."""
    large = 0
    for i in range(lanes):
        turn = ideal.held_turn(three(x, OMEGA, i), three(x, U, i), dt)
        squared = dot(turn, turn)
        x[FIRST, i], x[SECOND, i] = ideal.small_turn(squared)
        large += not squared < ideal.SMALL_TURN_SQUARED
    if large > 0:
        for i in range(lanes):
            turn = ideal.held_turn(three(x, OMEGA, i), three(x, U, i), dt)
            squared = dot(turn, turn)
            if not squared < ideal.SMALL_TURN_SQUARED:
                x[FIRST, i], x[SECOND, i] = ideal.large_turn(squared)


@kernel
def _held(evaluate, x, i, goal, gains, dt):
    """`ideal.held_step` with these coefficients."""
    omega, u = three(x, OMEGA, i), three(x, U, i)
    at = ideal.turned_by(rotation(x, R, i), ideal.held_turn(omega, u, dt), x[FIRST, i], x[SECOND, i])
    return at, ideal.plus(omega, dt, u)


@kernel
def _nothing(x, lanes, dt):
    return None


@kernel
def _rk4(evaluate, x, i, goal, gains, dt):
    omega, u = three(x, OMEGA, i), three(x, U, i)
    return ideal.rk4_step(evaluate, rotation(x, R, i), omega, u, goal, gains, memory_at(x, i), dt)


STEPS = {"ideal-rk4": (_nothing, _rk4), "ideal-held": (_series, _held)}

EPISODES = types.void(FOUR, MATRIX, NUMBERS, MATRIX)


def episodes_of(engine, evaluate, observe, metrics: int, cache: bool = True):
    """Return the loop of one law and so many metrics: `episodes(memory0, starts, numbers, rows)` fills the last."""
    prepare, step = STEPS[engine]
    columns = FIRST_METRIC + metrics

    def episodes(memory0, starts, numbers, rows):
        gains, dt = Tuning(numbers.kp, numbers.kv, numbers.bound, numbers.delay), numbers.dt
        x, n, measured = np.zeros((REALS, LANES)), np.zeros((INTEGERS, LANES), np.int64), np.zeros((columns, LANES))
        for i in range(LANES):
            n[EPISODE, i], n[ENDED, i] = NONE, 1
        begun, live, ended = 0, LANES, LANES
        while True:
            i = 0 if ended > 0 else live
            while i < live:
                if n[ENDED, i] == 0:
                    i += 1
                    continue
                if n[EPISODE, i] != NONE:
                    end(x, n, i, rows[n[EPISODE, i]], measured, numbers)
                if begun < starts.shape[0]:
                    begin(x, n, i, begun, starts[begun], memory0, numbers)
                    for column in range(columns):
                        measured[column, i] = rows[begun, column]
                    begun += 1
                else:
                    live -= 1
                    copy(x, i, live)
                    copy(n, i, live)
                    copy(measured, i, live)
            if live == 0:
                break
            lanes = (live + VECTOR - 1) & -VECTOR
            failed = 0
            for i in range(lanes):
                at, omega, before = rotation(x, R, i), three(x, OMEGA, i), three(x, U, i)
                goal = Goal(rotation(x, R_D, i), AT_REST, AT_REST)
                u, memory, margin = evaluate(at, omega, goal, gains, memory_at(x, i))
                entered, at_rest = n[ENTRIES, i] > 0, n[REST, i] > 0
                sample = Sample(n[TICK, i] * dt, dt, at, x[HAVERSINE, i], entered, at_rest, omega, u, before, margin)
                observe(measured[:, i], sample)
                set_three(x, U, i, u)
                set_memory(x, i, memory)
                n[FAILURE, i] = check_command(dot(u, u), numbers.command_limit_squared)
                failed += n[FAILURE, i] != GOING
            if failed > 0:
                for i in range(live):
                    if n[FAILURE, i] != GOING:
                        end(x, n, i, rows[n[EPISODE, i]], measured, numbers)
            prepare(x, lanes, dt)
            ended = 0
            for i in range(lanes):
                R_d = rotation(x, R_D, i)
                at, omega = step(evaluate, x, i, Goal(R_d, AT_REST, AT_REST), gains, dt)
                speed, hav, tick = dot(omega, omega), ideal.haversine(at, R_d), n[TICK, i] + 1
                failure = check_state(speed, numbers.speed_limit_squared)
                watch = watched(watch_of(n, i), tick, hav, x[BAND, i], speed, numbers.slow_squared)
                set_state(x, i, at, omega, hav)
                set_watch(n, i, watch, tick, failure, numbers)
                ended += n[ENDED, i] & (i < live)

    return compile_function(episodes, EPISODES, cache, forceinline=True)
