"""The free body behind goals that come as a stream: one episode of given length, whatever becomes of it."""

import math
from typing import NamedTuple

import numpy as np

from bench.engines.binding import memory_of
from bench.engines.episode import START_WIDTH, Numbers
from bench.engines.plants import quaternion
from bench.engines.simulate import compiled_loop, evaluation, simulate
from bench.law.contender import Contender
from bench.law.inputs import Gains


class Seen(NamedTuple):
    """Greatest |u| [rad/s^2], greatest angle to the true goal [rad], path turned [rad]."""

    peak_u: float
    off_rad: float
    way_rad: float


def run(
    contender: Contender, goals: np.ndarray, truth: np.ndarray, gains: Gains, dt: float, is_raw: bool = False
) -> Seen:
    """One episode from rest at the first true goal.

    Args:
        goals, truth: one a tick (n x 4). is_raw: the spring on the quaternion as it came, in the law's place.
    """
    start, rows = np.zeros((1, START_WIDTH)), np.zeros((1, quaternion.PATH + 1))
    start[0, 0:4], start[0, 7:11] = truth[0], goals[0]
    limits = Numbers(*gains, dt, len(goals), len(goals) + 1, 1, *(math.inf,) * 3, 0.0, 0.0)
    stream = quaternion.Stream(goals, truth, int(is_raw))
    simulate(compiled_loop("stream"), (evaluation(contender),), stream, memory_of(contender), start, limits, rows)
    return Seen(*rows[0, quaternion.PEAK :].tolist())
