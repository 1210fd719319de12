"""Estimates with intervals, and quantiles instead of means: what laws are compared by.

A start that a law never settles has no time. It counts as infinite here, not as missing: left out, a law that fails
from the hard starts would look fast. Quantiles are therefore order statistics, never interpolated.
"""

import functools
import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

SEED = 1988
RESAMPLES = 2000
"""The ends of a 95 % interval are then known to 0.06 of a standard error."""

TAIL = 0.025


class Estimate(NamedTuple):
    """A number and its 95 % interval."""

    value: float
    low: float
    high: float


NORMAL = 1.959963984540054
"""The 97.5 % quantile of the normal distribution."""


def wilson(count: int, of: int) -> tuple[float, float]:
    """Return the 95 % interval of a share, of at least one (E. Wilson, J. Amer. Statist. Assoc. 22, 1927)."""
    share, square = count / of, NORMAL**2 / of
    middle = share + 0.5 * square
    half = NORMAL * math.sqrt(share * (1.0 - share) / of + 0.25 * square / of)
    low, high = (middle - half) / (1.0 + square), (middle + half) / (1.0 + square)
    return (0.0 if count == 0 else low, 1.0 if count == of else high)


def quantile(values: np.ndarray, level: float, axis: int = -1) -> np.ndarray:
    """Return the smallest value that at least a share `level` of the values do not exceed; infinities are values."""
    # 0.07 * 100 is 7.000000000000001, which is no reason to take the eighth
    place = max(0, math.ceil(level * np.shape(values)[axis] - 1e-9) - 1)
    return np.take(np.partition(values, place, axis=axis), place, axis=axis)


def order_interval(count: int, level: float) -> tuple[int, int]:
    """Return the places in order, from 0, of the ends of a quantile's 95 % interval; of few values the whole range.

    The number of values below the quantile is binomial (W. Conover, Practical Nonparametric Statistics, 1999, 3.2).
    """
    from scipy.stats import binom

    low, high = binom.ppf((TAIL, 1.0 - TAIL), count, level)
    return max(0, int(low) - 1), min(count - 1, int(high))


def bootstrap(values: np.ndarray, statistic: Callable[..., np.ndarray], seed: int = SEED) -> Estimate:
    """Return the percentile interval over resamples with replacement (Efron 1979), the same starts for every law.

    Of evenly spread starts, which vary less than random ones, the interval is on the wide side. values: one number a
    start, shape (n,), at least one. statistic(values, axis=-1) -> one number along that axis.
    """
    found = resampled(values, statistic, seed)
    low, high = quantile(found, TAIL), quantile(found, 1.0 - TAIL)
    return Estimate(float(statistic(values, axis=-1)), float(low), float(high))


def resampled(values: np.ndarray, statistic: Callable[..., np.ndarray], seed: int = SEED) -> np.ndarray:
    """Return a statistic of each resample, shape (RESAMPLES,), of at least one value; the same starts for every law.

    So the difference of two laws' is the paired bootstrap of their difference.
    """
    if not len(values):
        raise ValueError("no values to resample (allowed: at least one)")
    return statistic(np.asarray(values)[_resamples(len(values), seed)], axis=-1)


@functools.lru_cache(maxsize=4)
def _resamples(count: int, seed: int) -> np.ndarray:
    """Numbers of the values in each resample, shape (RESAMPLES, count): the same for every law and criterion."""
    return np.random.default_rng(seed).integers(count, size=(RESAMPLES, count), dtype=np.int32)


def quantile_estimate(values: np.ndarray, level: float, seed: int = SEED) -> Estimate:
    """Return a quantile with its interval."""
    return bootstrap(values, lambda drawn, axis: quantile(drawn, level, axis), seed)


def resampled_quantile(values: np.ndarray, level: float, seed: int = SEED) -> np.ndarray:
    """Return `resampled` of a high quantile, number for number, by the greatest values alone.

    A resample is how often each value was drawn. Its quantile is the value at which the counts, from the greatest value
    down, first exceed the number of values that lie above the quantile; a few of the greatest are enough.
    """
    values = np.asarray(values)
    above = len(values) - math.ceil(level * len(values) - 1e-9)
    counts = _resampled_counts(len(values), seed)
    order = np.argsort(-values, kind="stable")
    most = 4 * above + 32
    while True:
        greatest = order[:most]
        reached = counts[:, greatest].cumsum(axis=1) > above
        if reached[:, -1].all():
            return values[greatest][reached.argmax(axis=1)]
        most *= 2


@functools.lru_cache(maxsize=8)
def _resampled_counts(count: int, seed: int) -> np.ndarray:
    """How often each value is in each resample, shape (RESAMPLES, count): of the same resamples as `_resamples`."""
    drawn = _resamples(count, seed) + count * np.arange(RESAMPLES, dtype=np.int64)[:, None]
    return np.bincount(drawn.ravel(), minlength=RESAMPLES * count).reshape(RESAMPLES, count).astype(np.int32)
