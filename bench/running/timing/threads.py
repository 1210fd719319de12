"""Two threads against one: the same pieces of work, timed on the wall, in turn.

A piece is a second's episode of an arm, with a simulation of its own; the threads share nothing but compiled code, and
the compiled loop holds no lock of Python's. Repetitions alternate, each in an order of its own, and the speed-up is the
median of one thread's time over two threads' of the same repetition.

Limitations: says little on a machine that others use, or with one core.
"""

import random
import time
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import numpy as np

from bench.law.contender import Contender
from bench.law.contenders import combinations
from bench.law.contenders.registry import find_contender
from bench.running.timing import on_arms
from bench.running.timing.ratios import Ratio, ratio

ARM, WORD = "ur5e", "rotation-matrix@geometric+solve"
PIECES = 16
HORIZON_S = 4.0
"""Some 10 ms a piece, a thousand times what it takes to hand one to a thread."""

REPETITIONS, QUICK_REPETITIONS = 21, 5


class Scaling(NamedTuple):
    """ns a tick on the wall with two threads, and how many times as fast as one they were."""

    contender: Contender
    arm: str
    ns_per_tick: float
    ticks: int
    repetitions: int
    speedup: Ratio


def measure(repetitions: int, seed: int = 0) -> Scaling:
    """Time the pieces with one thread and with two."""
    law = WORD.partition("@")[0]
    [one] = combinations.on((WORD,), {law: find_contender(law)}, 6)
    pieces = [on_arms.native(ARM, one, HORIZON_S) for _ in range(PIECES)]
    order, seconds = random.Random(seed), np.empty((repetitions, 2))
    with ThreadPoolExecutor(1) as single, ThreadPoolExecutor(2) as double:
        pools = {0: single, 1: double}
        for row in seconds:
            for column in order.sample((0, 1), 2):
                began = time.perf_counter()
                list(pools[column].map(lambda piece: piece.call(), pieces))
                row[column] = time.perf_counter() - began
    ticks = sum(piece.ticks for piece in pieces)
    ns = float(np.median(seconds[:, 1])) / ticks * 1e9
    return Scaling(one, ARM, ns, ticks, repetitions, ratio(seconds[:, 0], seconds[:, 1]))
