"""Limiters of velocity commands: what holds of each, and of one alone."""

import numpy as np
import pytest

from bench.experiments.limiters import GREATEST_RATE, LIMITERS

K = 10.0


def commands():
    rng = np.random.default_rng(5)
    directions = rng.normal(size=(200, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    return directions * np.geomspace(1e-4, 40.0, 200)[:, None]


@pytest.mark.parametrize("limiter", LIMITERS.values(), ids=LIMITERS)
def test_limiter_lengthens_and_reverses_no_component(limiter):
    for omega in commands():
        limited = np.array(limiter.limit(tuple(omega), K))
        assert (limited * omega >= 0.0).all()
        assert (np.abs(limited) <= np.abs(omega)).all()


@pytest.mark.parametrize("limiter", LIMITERS.values(), ids=LIMITERS)
def test_limiter_passes_the_middle_of_its_range_as_it_is(limiter):
    omega = (0.5, -0.6, 0.7)
    assert limiter.limit(omega, K) == omega


@pytest.mark.parametrize("name", LIMITERS)
def test_limiter_is_odd(name):
    for omega in commands():
        there = LIMITERS[name].limit(tuple(omega), K)
        back = LIMITERS[name].limit(tuple(-omega), K)
        np.testing.assert_array_equal(there, -np.array(back))


def test_norm_clamp_keeps_the_direction_and_the_clamp_per_axis_does_not():
    omega = np.array((9.0, 3.0, 1.0))
    kept, bent = (np.array(LIMITERS[name].limit(tuple(omega), K)) for name in ("norm-clamp", "axis-clamp"))
    np.testing.assert_allclose(np.cross(kept, omega), 0.0, atol=1e-15)
    assert np.linalg.norm(kept) == pytest.approx(GREATEST_RATE)
    np.testing.assert_array_equal(bent, (GREATEST_RATE, GREATEST_RATE, 1.0))


def test_deadband_is_of_the_error_whatever_the_gain():
    limit = LIMITERS["deadband"].limit
    for gain in (1.0, 10.0, 300.0):
        assert limit((gain * 4.9e-3, gain * 5.1e-3, -gain * 4.9e-3), gain) == (0.0, gain * 5.1e-3, 0.0)
