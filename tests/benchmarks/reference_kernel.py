"""The reference kernel: fixed arithmetic whose time stands for the speed of the machine just then.

    x <- sqrt(2 + sin(((x/10 + 1/5) x + 3/10) x + k/1000)),   k = 0, 1, 2 ...

Each operation waits for the one before it, as in a law, so nothing is vectorized or overlapped. It
must never be changed: every stored ratio is a ratio to one step of exactly this. `RESULT` is its
value, by which a test knows it.

|dx'/dx| <= 0.366 (3 x^2/10 + 2 x/5 + 3/10) < 0.7 for x <= sqrt(3): the map forgets, so an ulp in
some libm's sine stays a few ulps, and RESULT holds on every machine.
"""

import functools
import time
from typing import Any

import numpy as np

from bench.engines.compiled import compile_on_demand
from bench.experiments.tables.statistics import order_interval
from bench.law.scalar import sin, sqrt
from benchmarks.subject import KERNEL, Subject

STEPS = 20_000
"""About half a millisecond: a thousand times what calling it costs."""

START = 0.5
RESULT = 1.599255347080933
TOLERANCE = 1e-14
"""One ulp of x is 2.2e-16; errors of an ulp in sine and root sum to under four of them."""


def chain(x, steps):
    """Return the value after so many steps; plain Python gives the same."""
    for k in range(steps):
        x = sqrt(2.0 + sin(((0.1 * x + 0.2) * x + 0.3) * x + 0.001 * k))
    return x


@functools.cache
def compiled():
    """Return the kernel compiled: compiled()(START, STEPS)."""
    return compile_on_demand(chain, is_kept=True)


def run() -> float:
    """Run the compiled kernel and return RESULT."""
    return compiled()(START, STEPS)


def time_step() -> float:
    """Return the CPU time of one step at this moment [s]."""
    began = time.thread_time()
    run()
    return (time.thread_time() - began) / STEPS


def reference_kernel() -> Subject:
    """Return the kernel as a subject, by which two saved runs say whether the machine changed."""
    run()
    return Subject(KERNEL, run, STEPS)


def compare(tick_s: np.ndarray, kernel_s: np.ndarray) -> dict[str, Any]:
    """Return the time of a tick in steps of the kernel, and the time of a step [ns].

    tick_s, kernel_s: one value a round, in the order of the rounds. kernel_steps: the median, and
    the low and the high end of its 95 % interval.
    """
    ratios = np.sort(tick_s / kernel_s)
    low, high = order_interval(len(ratios), 0.5)
    steps = [float(np.median(ratios)), float(ratios[low]), float(ratios[high])]
    return {"kernel_steps": steps, "kernel_ns": 1e9 * float(np.median(kernel_s))}
