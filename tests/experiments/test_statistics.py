"""Estimates against closed forms: the binomial law of a resampled quantile."""

import numpy as np
import pytest
from scipy.stats import binom

from bench.experiments.tables import statistics

NEVER = np.inf


def exact_quantile_interval(values, level):
    """The percentile interval for endlessly many resamples: P(resampled order statistic k <= x_(j)) is binomial."""
    n = len(values)
    k = int(np.ceil(level * n))
    reached = binom.sf(k - 1, n, np.arange(1, n + 1) / n)
    ends = (np.searchsorted(reached, tail) for tail in (statistics.TAIL, 1.0 - statistics.TAIL))
    return tuple(float(np.sort(values)[end]) for end in ends)


@pytest.mark.parametrize("level", [0.5, 0.9])
def test_interval_of_a_quantile_is_that_of_the_binomial_law(level):
    values = np.arange(400.0)
    found = statistics.quantile_estimate(values, level)
    # one standard error of the ends of 2000 resamples is about 0.06 standard errors of the quantile, 10 places here
    assert (found.low, found.high) == pytest.approx(exact_quantile_interval(values, level), abs=2.0)


def test_interval_covers_the_truth_as_often_as_it_says():
    rng = np.random.default_rng(2)
    estimates = [statistics.quantile_estimate(rng.exponential(size=80), 0.5, seed) for seed in range(200)]
    covered = sum(found.low <= np.log(2.0) <= found.high for found in estimates)
    assert 0.95 * 200 - 4 * np.sqrt(200 * 0.95 * 0.05) <= covered


def test_quantile_beyond_the_share_that_settles_is_never():
    times = np.array([1.0] * 98 + [NEVER] * 2)
    assert statistics.quantile_estimate(times, 0.5) == (1.0, 1.0, 1.0)
    assert statistics.quantile(times, 0.98) == 1.0
    found = statistics.quantile_estimate(times, 0.99)
    assert (found.value, found.high) == (NEVER, NEVER)


@pytest.mark.parametrize("level", [0.0, 0.3, 0.5, 0.98, 1.0])
def test_quantile_is_numpys_order_statistic(level):
    values = np.random.default_rng(5).normal(size=(100, 3))
    expected = np.quantile(values, level, axis=0, method="inverted_cdf")
    np.testing.assert_array_equal(statistics.quantile(values, level, axis=0), expected)


def test_bootstrap_refuses_nothing():
    with pytest.raises(ValueError, match="no values to resample"):
        statistics.bootstrap(np.array([]), np.mean)


def test_quantile_takes_the_seventh_of_a_hundred_for_seven_per_cent():
    assert statistics.quantile(np.arange(1.0, 101.0), 0.07) == 7.0
