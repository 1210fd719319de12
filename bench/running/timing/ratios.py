"""Ratios of benchmarks timed in the same pass: their median, and an interval that assumes no distribution."""

import numpy as np

from bench.experiments.tables.statistics import Estimate, order_interval


def ratio(times: np.ndarray, others: np.ndarray) -> Estimate:
    """Return the median ratio of two columns of times, one a pass; the passes are taken for independent.

    The interval covers the true median with 95 % confidence; of fewer than 6 passes with less.
    """
    ordered = np.sort(times / others)
    low, high = order_interval(len(ordered), 0.5)
    return Estimate(float(np.median(ordered)), float(ordered[low]), float(ordered[high]))
