"""Exact intervals of shares against SciPy's inverse of the beta distribution."""

import pytest
from scipy.stats import beta

from bench.findings.exact_interval import exact_interval

TAIL = 0.025


@pytest.mark.parametrize(
    ("count", "of"),
    [(0, 1), (1, 1), (1, 2), (0, 40_000), (1, 40_000), (9_624, 40_000), (999, 1_000), (500, 1_000), (3, 10**7)],
)
def test_interval_is_that_of_the_beta_distribution(count, of):
    low = beta.ppf(TAIL, count, of - count + 1) if count else 0.0
    high = beta.ppf(1.0 - TAIL, count + 1, of - count) if count < of else 1.0
    # rounding of log n!, some n log n times 1e-16
    assert exact_interval(count, of) == pytest.approx((low, high), rel=2e-8, abs=0.0)


def test_tail_of_no_success_is_in_closed_form():
    low, high = exact_interval(0, 1_000)
    assert low == 0.0
    assert high == pytest.approx(1.0 - TAIL ** (1.0 / 1_000), rel=1e-12)
