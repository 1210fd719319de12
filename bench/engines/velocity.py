"""The loop over episodes of a free body commanded by its angular velocity, held over each tick and followed exactly."""

import math
from typing import NamedTuple

import numpy as np
from numba import float64, types

from bench.control.velocity import velocity
from bench.engines.compiled import EVALUATE, FOUR, MATRIX, NUMBERS, THREE, compile_function
from bench.engines.episode import FIRST_METRIC, blamed, blank, finish
from bench.law.contender import AT_REST, Gains, Goal
from bench.law.scalar import atan2, kernel, sqrt
from bench.law.so3 import cross, dot, from_quaternion
from tasks.truth import angle, haversine
from tasks.velocity import turned
from tasks.verdict import GOING, check_command, first_watch, watched

PATH, FURTHEST, BENT, PEAK, RATE, OFF = range(FIRST_METRIC, FIRST_METRIC + 6)
"""A row's columns after the judge's: way turned [rad], greatest haversine, greatest angle [rad] by which the limiter
bent a command, greatest |omega| [rad/s]; on arms greatest |qdot| [rad/s] and distance of the tool from its place [m],
of which the free body has none."""


class Pace(NamedTuple):
    """K [1/s], and the tick [s] and what it makes of a servo's lag: see tasks.velocity.Servo."""

    K: float
    dt: float
    decay: float
    coast: float


PACE = types.NamedUniTuple(float64, 4, Pace)
LIMIT = THREE(THREE, float64)
"""limit(omega, K) -> omega."""

EPISODES = types.void(
    types.FunctionType(EVALUATE), types.FunctionType(LIMIT), FOUR, MATRIX, PACE, NUMBERS, MATRIX
)  # fmt: skip


def blank_rows(count: int) -> np.ndarray:
    """Rows to be filled."""
    rows = np.hstack((blank(count, ()), np.zeros((count, 6))))
    rows[:, OFF] = math.nan
    return rows


@kernel
def see(row, hav, asked, omega):
    """Keep the greatest of what is seen at one tick."""
    turned_off, along = cross(asked, omega), dot(asked, omega)
    bend = atan2(sqrt(dot(turned_off, turned_off)), along)
    speed = sqrt(dot(omega, omega))
    row[FURTHEST] = hav if hav > row[FURTHEST] else row[FURTHEST]
    row[BENT] = bend if bend > row[BENT] and speed > 0.0 else row[BENT]
    row[PEAK] = speed if speed > row[PEAK] else row[PEAK]


def episodes_of():
    """The loop: `episodes(evaluate, limit, memory0, starts, pace, numbers, rows)` fills the last."""

    def episodes(evaluate, limit, memory0, starts, pace, numbers, rows):
        gains, dt = Gains(numbers.kp, numbers.kv), numbers.dt
        for k in range(starts.shape[0]):
            start, row = starts[k], rows[k]
            quat = (start[0], start[1], start[2], start[3])
            quat_d = (start[7], start[8], start[9], start[10])
            goal = Goal(from_quaternion(quat_d), AT_REST, AT_REST)
            band, memory, u, speed = start[11], memory0, AT_REST, 0.0
            hav = haversine(quat, quat_d)
            watch = first_watch(hav, band, speed, numbers.slow_squared)
            tick, failure = 0, GOING
            while tick < numbers.ticks and watch.quiet < numbers.hold_ticks:
                u, memory, _ = evaluate(from_quaternion(quat), AT_REST, goal, gains, memory)
                asked, omega = velocity(limit, u, pace.K, gains.kp)
                speed = dot(omega, omega)
                failure = check_command(speed, numbers.speed_limit_squared)
                if failure != GOING:
                    break
                see(row, hav, asked, omega)
                quat = turned(quat, (dt * omega[0], dt * omega[1], dt * omega[2]))
                row[PATH] += dt * sqrt(speed)
                tick += 1
                hav = haversine(quat, quat_d)
                watch = watched(watch, tick, hav, band, speed, numbers.slow_squared)
            finish(row, blamed(failure, u), watch, tick, angle(quat, quat_d), speed, speed, numbers)

    return compile_function(episodes, EPISODES)
