"""Ratios of benchmarks timed in the same pass: their median, and an interval that assumes no distribution."""

import numpy as np

from bench.experiments.tables.statistics import Estimate, order_interval


def ratio(times: np.ndarray, others: np.ndarray) -> Estimate:
    """Return the median ratio of two columns of independent passes, and its interval: 95 %, but less under 6 passes."""
    ordered = np.sort(times / others)
    low, high = order_interval(len(ordered), 0.5)
    return Estimate(float(np.median(ordered)), float(ordered[low]), float(ordered[high]))
