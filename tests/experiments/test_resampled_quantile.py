"""The quantile of resamples by the greatest values alone, against the one that takes every value."""

import numpy as np
import pytest

from bench.experiments.tables.statistics import quantile, resampled, resampled_quantile


@pytest.mark.parametrize("count", [50, 512, 1024])
@pytest.mark.parametrize("level", [0.9, 0.99])
def test_quantile_of_resamples_is_the_same_number_for_number(count, level):
    values = np.random.default_rng(count).gamma(2.0, size=count)
    values[:3] = np.inf
    again = resampled(values, lambda drawn, axis: quantile(drawn, level, axis))
    assert np.array_equal(resampled_quantile(values, level), again)


def test_equal_values_have_equal_resamples():
    assert (resampled_quantile(np.ones(64), 0.99) == 1.0).all()
