"""Episodes as curves: what the compiled loops keep of the state every so many ticks, where there is room for it."""

from typing import NamedTuple

import numpy as np

from bench.engines.arm_episode import MOST
from bench.engines.arrays import Cube
from bench.law.scalar import kernel, sqrt
from bench.law.so3 import dot, minus

_VECTORS = ("n", "o", "a", "omega", "u")
NUMBERS = ("time_s", *(f"{vector}_{axis}" for vector in _VECTORS for axis in "xyz"), "haversine")
ARM_NUMBERS = (*NUMBERS, "position_error_m", *(f"q_{i}" for i in range(1, MOST + 1)))
"""A sample's numbers in their order; those of an arm go on with the tool's distance from its place and the joints."""

WIDTH = len(NUMBERS)


class Curves(NamedTuple):
    """Curves to be filled: ticks from one sample to the next, and episodes x samples x numbers.

    Of an episode that ends early the last samples stay as they were.
    """

    every: int
    samples: Cube


def blank_curves(count: int, samples: int = 0, every: int = 1, numbers: tuple = NUMBERS) -> Curves:
    """Room for so many samples of each episode, none of them there yet."""
    return Curves(every, np.full((count, samples, len(numbers)), np.nan))


@kernel
def keep(curves, k, tick, sample):
    """Store episode k's sample of this tick, if it is due and there is room."""
    if tick < curves.every * curves.samples.shape[1] and tick % curves.every < 1:
        store(curves.samples[k, tick // curves.every], sample)


@kernel
def keep_on_arm(curves, k, tick, sample):
    """Keep a sample of an arm."""
    if tick < curves.every * curves.samples.shape[1] and tick % curves.every < 1:
        kept = curves.samples[k, tick // curves.every]
        store(kept, sample)
        away = minus(sample.p, sample.p_d)
        kept[WIDTH] = sqrt(dot(away, away))
        for i in range(MOST):
            kept[WIDTH + 1 + i] = sample.q[i]


@kernel
def store(kept, sample):
    """One sample's numbers."""
    R, omega, u = sample.R, sample.omega, sample.u
    kept[0] = sample.time
    for i in range(3):
        kept[1 + i] = R.n[i]
        kept[4 + i] = R.o[i]
        kept[7 + i] = R.a[i]
        kept[10 + i] = omega[i]
        kept[13 + i] = u[i]
    kept[16] = sample.haversine
