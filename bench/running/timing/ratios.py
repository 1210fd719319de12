"""Ratios of benchmarks timed in the same pass: their median, and an interval that assumes no distribution."""

from typing import NamedTuple

import numpy as np
from scipy.stats import binom

CONFIDENCE = 0.95


class Ratio(NamedTuple):
    """Median over passes, and the interval that covers the true median with at least 95 % confidence."""

    median: float
    low: float
    high: float


def ranks(passes: int) -> tuple[int, int]:
    """Places, from 0, of the ordered sample that bound its median.

    The k-th smallest and k-th largest of n bound the median with probability 1 - 2 P(B < k), B binomial (n, 1/2)
    (for independent passes; Conover 1999, 3.2). The largest such k is taken; below 6 passes the whole range is, with
    less confidence.
    """
    k = max(1, int(binom.ppf((1.0 - CONFIDENCE) / 2.0, passes, 0.5)))
    return k - 1, passes - k


def ratio(times: np.ndarray, others: np.ndarray) -> Ratio:
    """Return the ratio of two columns of times, pass by pass.

    Args:
        times, others: one number a pass, in the same unit.
    """
    ordered = np.sort(times / others)
    low, high = ranks(len(ordered))
    return Ratio(float(np.median(ordered)), float(ordered[low]), float(ordered[high]))
