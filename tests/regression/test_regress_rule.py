"""The rule of the timing gate, on made-up rounds: both conditions are needed, and a second run."""

import numpy as np
import pytest

from bench.regression.revisions.rule import RATIO, P, confirmed, judge

SEED = 20


def rounds(factor=1.0, spread=0.01, count=60):
    """(base, head): log-normal times, the head's times the factor."""
    draw = np.random.default_rng(SEED)
    return draw.lognormal(sigma=spread, size=count), factor * draw.lognormal(sigma=spread, size=count)


@pytest.mark.parametrize("factor", [1.0, 1.05, 1.09, 0.95])
def test_law_is_the_same_when_its_ratio_is_within_a_tenth_however_sure_that_is(factor):
    found = judge(*rounds(factor))
    assert found.verdict == "same"
    assert (found.p < P) == (factor != 1.0)


def test_law_is_the_same_when_its_ratio_may_be_chance():
    found = judge(*rounds(1.15, spread=0.8))
    assert found.ratio > RATIO
    assert found.p > P
    assert found.verdict == "same"


@pytest.mark.parametrize(("factor", "verdict"), [(1.2, "slower"), (1.0 / 1.2, "faster")])
def test_law_is_another_when_both_conditions_hold(factor, verdict):
    found = judge(*rounds(factor))
    assert found.verdict == verdict
    assert found.low < factor < found.high
    assert found.rounds == 60
    assert found.confirmed is None


def test_ratio_is_of_neighbouring_rounds_whatever_the_machine_does():
    base, head = rounds(1.2)
    drift = np.linspace(1.0, 3.0, len(base))
    assert judge(base * drift, head * drift).ratio == pytest.approx(judge(base, head).ratio, rel=1e-12)


def test_second_run_that_agrees_confirms_and_gives_the_numbers():
    first, second = judge(*rounds(1.5)), judge(*rounds(1.2))
    found = confirmed(first, second)
    assert (found.verdict, found.confirmed, found.ratio) == ("slower", True, second.ratio)


@pytest.mark.parametrize("factor", [1.0, 1.0 / 1.5])
def test_second_run_that_does_not_agree_takes_the_verdict_back(factor):
    found = confirmed(judge(*rounds(1.5)), judge(*rounds(factor)))
    assert (found.verdict, found.confirmed) == ("same", False)
