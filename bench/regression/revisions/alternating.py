"""Base and head in turn, round by round: which of the two begins a pair is drawn anew each time.

Both rounds of a pair run on one core, drawn for each benchmark, while the other process waits: else one side might sit
beside a busy neighbour for the whole of it.
"""

import random
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from bench.regression.revisions.measurement import Spread
from bench.regression.revisions.process import Process, cores
from bench.timing.ratios import ratio

ROUNDS = 60
"""Pairs. The interval of a median covers the 23rd to 38th of 60; a round takes from 0.3 ms to 10 ms."""


class Rounds(NamedTuple):
    """Seconds a tick, and a step of the reference kernel just before; one number a round each."""

    ticks: np.ndarray
    kernel: np.ndarray

    def kernel_steps(self) -> Spread:
        """Time a tick over the kernel's step."""
        return Spread(*ratio(self.ticks, self.kernel))


def take(
    sides: list[Process], names: list[str], rounds: int = ROUNDS, seed: int = 0, report: Callable = lambda _: None
) -> list[dict[str, Rounds]]:
    """The rounds of every side, by name; one side alone is timed by itself.

    Args:
        report: called with each name when its rounds are done.
    """
    draw, places = random.Random(seed), cores()
    for side in sides:
        side.say(order=names, rounds=rounds)
        side.hear()
    last: dict[int, dict] = {}
    for name in names:
        core = draw.choice(places)
        for _ in range(rounds):
            for at in draw.sample(range(len(sides)), len(sides)):
                sides[at].say(core=core)
                last[at] = sides[at].hear()  # it waits for its next round, so this one is done
        report(name)
    return [
        {name: Rounds(*np.array(pairs).T) for name, pairs in last[at]["seconds"].items()} for at in range(len(sides))
    ]
