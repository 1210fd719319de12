"""Ratios of benchmarks timed in the same pass: their median, and an interval that assumes no distribution."""

from typing import NamedTuple

import numpy as np

from bench.experiments.tables.statistics import order_interval


class Ratio(NamedTuple):
    """Median over passes, and the interval that covers the true median with 95 % confidence; below 6 with less."""

    median: float
    low: float
    high: float


def ratio(times: np.ndarray, others: np.ndarray) -> Ratio:
    """Return the ratio of two columns of times, pass by pass; the passes are taken for independent.

    Args:
        times, others: one number a pass, in the same unit.
    """
    ordered = np.sort(times / others)
    low, high = order_interval(len(ordered), 0.5)
    return Ratio(float(np.median(ordered)), float(ordered[low]), float(ordered[high]))
