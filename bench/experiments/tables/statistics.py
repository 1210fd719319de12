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

NOTHING = "no values to resample (allowed: at least one)"


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


def place_of_quantile(count: int, level: float) -> int:
    """Return the place in order, from 0, of the smallest value that at least a share `level` do not exceed."""
    # 0.07 * 100 is 7.000000000000001, which is no reason to take the eighth
    return max(0, math.ceil(level * count - 1e-9) - 1)


def quantile(values: np.ndarray, level: float, axis: int = -1) -> np.ndarray:
    """Return the smallest value that at least a share `level` of the values do not exceed; infinities are values."""
    place = place_of_quantile(np.shape(values)[axis], level)
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
    return percentile_estimate(statistic(values, axis=-1), found)


def percentile_estimate(value: float | np.ndarray, found: np.ndarray) -> Estimate:
    """Return a statistic with its percentile interval; found: the statistic of each resample, shape (RESAMPLES,)."""
    low, high = quantile(found, TAIL), quantile(found, 1.0 - TAIL)
    return Estimate(float(value), float(low), float(high))


def resampled(values: np.ndarray, statistic: Callable[..., np.ndarray], seed: int = SEED) -> np.ndarray:
    """Return a statistic of each resample, shape (RESAMPLES,), of at least one value; the same starts for every law.

    So the difference of two laws' is the paired bootstrap of their difference.
    """
    if not len(values):
        raise ValueError(NOTHING)
    return statistic(np.asarray(values)[_resamples(len(values), seed)], axis=-1)


@functools.lru_cache(maxsize=4)
def _resamples(count: int, seed: int) -> np.ndarray:
    """Numbers of the values in each resample, shape (RESAMPLES, count): the same for every law and criterion."""
    return np.random.default_rng(seed).integers(count, size=(RESAMPLES, count), dtype=np.int32)


def quantile_estimate(values: np.ndarray, level: float, seed: int = SEED) -> Estimate:
    """Return a quantile with its interval, as `bootstrap` has it."""
    found = resampled_quantile(values, level, seed)
    return percentile_estimate(quantile(values, level), found)


REACH = 5.0
"""How far from the quantile of all values that of a resample is looked for first, in standard deviations."""


def resampled_quantile(values: np.ndarray, level: float, seed: int = SEED) -> np.ndarray:
    """Return `resampled` of a quantile, number for number, by the values near the quantile alone.

    A resample is how often each value was drawn. Its quantile is the value at which the counts, from the least value
    up, first exceed the place of the quantile. The place is binomial: with n values and level p the value lies within
    some sqrt(n p (1 - p)) places of the quantile of the values themselves.
    """
    values = np.asarray(values)
    total = len(values)
    if not total:
        raise ValueError(NOTHING)
    place = place_of_quantile(total, level)
    counts = _resampled_counts(total, seed)
    order = np.argsort(values, kind="stable")
    share = (place + 1) / total
    reach = math.ceil(REACH * math.sqrt(total * share * (1.0 - share))) + 8
    while True:
        first, last = max(0, place - reach), min(total, place + reach)
        below = _count_among(counts, order[:first])
        near = order[first:last]
        up_to = below[:, None] + counts[:, near].cumsum(axis=1, dtype=counts.dtype)
        exceeds = up_to > place
        if (below <= place).all() and exceeds[:, -1].all():
            return values[near][exceeds.argmax(axis=1)]
        reach *= 2


def _count_among(counts: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Return how many values of each resample are among those at some places, from the fewer of these and the others.

    counts: how often each value is in each resample, (RESAMPLES, n). A resample has n values.
    """
    total = counts.shape[1]
    if len(places) <= total // 2:
        return counts[:, places].sum(axis=1, dtype=counts.dtype)
    is_other = np.ones(total, dtype=bool)
    is_other[places] = False
    return total - counts[:, is_other].sum(axis=1, dtype=counts.dtype)


PARTS = 50
"""Parts in which resamples are summed: of 40 resamples each."""


def resampled_slope(x: np.ndarray, y: np.ndarray, seed: int = SEED) -> np.ndarray:
    """Return the least-squares slope of y against x in each resample, shape (RESAMPLES,); NaN where all x are equal.

    slope = (sum xy - sum x sum y / n) / (sum xx - sum x sum x / n), sums over the n values drawn, from the mean of all.
    """
    from_mean, rise = x - x.mean(), y - y.mean()
    products = [from_mean, rise, from_mean * rise, from_mean * from_mean]
    weights = np.stack(products, axis=1)
    # In parts that stay in the cache, and for which OpenBLAS wakes no threads: they wait at full speed.
    parts = np.array_split(_resampled_counts(len(x), seed), PARTS)
    sum_x, sum_y, sum_xy, sum_xx = np.concatenate([part @ weights for part in parts]).T
    with np.errstate(invalid="ignore"):
        return (sum_xy - sum_x * sum_y / len(x)) / (sum_xx - sum_x * sum_x / len(x))


@functools.lru_cache(maxsize=16)
def _resampled_counts(count: int, seed: int) -> np.ndarray:
    """How often each value is in each resample, shape (RESAMPLES, count): of the same resamples as `_resamples`."""
    is_small = count <= np.iinfo(np.int16).max
    counts = np.empty((RESAMPLES, count), dtype=np.int16 if is_small else np.int32)
    for row, drawn in zip(counts, _resamples(count, seed), strict=True):
        row[:] = np.bincount(drawn, minlength=count)
    return counts
