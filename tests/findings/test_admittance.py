"""Limits of an admittance over a position loop: Nyquist's against Jury's, Routh's and the eigenvalues of a map."""

import math

import numpy as np
import pytest

from bench.findings.theory.admittance import Admittance, Loop, lagged_limit, routh_limit, settles, step
from bench.findings.theory.contact_stability import Spring
from bench.studies.contact.admittance import SHIPPED

DT = 1e-3
SOFT = Admittance(5.0, 200.0)


def lagged_map(one: Admittance, K: float, lag_s: float, late: int, dt: float) -> np.ndarray:
    """(x, c, cdot, commands of the last ticks) over a tick, written down anew."""
    a, size = math.exp(-dt / lag_s) if lag_s > 0.0 else 0.0, 3 + late
    made = np.zeros((size, size))
    made[2, :3] = -dt * K / one.m, -dt * one.k / one.m, 1.0 - dt * one.d / one.m
    made[1] = dt * made[2]
    made[1, 1] += 1.0
    told = made[1] if late == 0 else np.eye(size)[-1]
    made[0] = (1.0 - a) * told
    made[0, 0] += a
    for i in range(late):
        made[3 + i] = made[1] if i == 0 else np.eye(size)[2 + i]
    return made


def radius(matrix: np.ndarray) -> float:
    return float(np.abs(np.linalg.eigvals(matrix)).max())


@pytest.mark.parametrize("lag_s", [0.0, 0.003, 0.03])
@pytest.mark.parametrize("late", [0, 1, 2, 7, 20])
@pytest.mark.parametrize("one", [SHIPPED, SOFT], ids=["shipped", "soft"])
def test_limit_is_where_the_maps_eigenvalues_cross_the_circle(one, late, lag_s):
    K = lagged_limit(one, lag_s, late, DT)
    assert (
        radius(lagged_map(one, 0.999 * K, lag_s, late, DT)) < 1.0 < radius(lagged_map(one, 1.001 * K, lag_s, late, DT))
    )


@pytest.mark.parametrize("lag_s", [0.003, 0.01, 0.1])
@pytest.mark.parametrize("one", [SHIPPED, SOFT], ids=["shipped", "soft"])
def test_limit_of_short_ticks_is_rouths(one, lag_s):
    assert lagged_limit(one, lag_s, 0, 1e-6) == pytest.approx(routh_limit(one, lag_s), rel=1e-3)
    roots = [
        np.roots((one.m * lag_s, one.m + one.d * lag_s, one.d + one.k * lag_s, one.k + share * routh_limit(one, lag_s)))
        for share in (0.999, 1.001)
    ]
    assert roots[0].real.max() < 0.0 < roots[1].real.max()


def test_arms_loop_far_faster_than_its_admittance_has_the_limit_of_the_lagged_one():
    """A stiff double pole w is a lag of 2/w at low frequencies; the sensor is a tick late."""
    w, dt = 2000.0, 1e-5
    K = lagged_limit(SHIPPED, 2.0 / w, 500, dt)
    loop = Loop(w, 499, 1e-6)
    assert settles(SHIPPED, loop, Spring(0.97 * K, 0.0), dt)
    assert not settles(SHIPPED, loop, Spring(1.03 * K, 0.0), dt)


def test_slow_roots_of_the_arms_loop_are_those_of_its_polynomial():
    """(m s^2 + d s + k)(s^2 + 2 w s + w^2 + A K) + w^2 K = 0."""
    (m, d, k), w, A, K, dt = SHIPPED, 50.0, 0.3, 3e3, 1e-6
    polynomial = np.polyadd(np.polymul((m, d, k), (1.0, 2.0 * w, w * w + A * K)), (w * w * K,))
    found = np.linalg.eigvals(step(SHIPPED, Loop(w, 0, A), Spring(K, 0.0), dt))
    for root in np.roots(polynomial):
        assert np.abs(found - np.exp(root * dt)).min() <= 1e-2 * abs(root) * dt
