"""A sampled press on a spring, against its own continuous equation, against Hurwitz, and against MuJoCo."""

import numpy as np
import pytest
from scipy.optimize import brentq

from bench.findings.theory.contact_stability import Spring, acceleration, settles, step
from bench.law.control.registry import find_controller
from bench.law.control.setpoint import TOUCH
from bench.studies.contact import stability

A = 0.35
TRANSPOSE = find_controller("hybrid-base+transpose")
INVERSE = find_controller("hybrid-base+inverse")


def late_boundary(kf: float, late_s: float, B_over_K: float) -> float:
    """K at which s = i w solves s^2 + kc s + A (K + B s)(1 + kf exp(-s T)) = 0, the least of them."""

    def stiffness(w):
        s = 1j * w
        factor = A * (1.0 + B_over_K * s) * (1.0 + kf * np.exp(-s * late_s))
        return -(s * s + TOUCH.kc * s) / factor

    grid = np.geomspace(0.01, 3.0, 3000) * np.pi / late_s
    imaginary = np.imag([stiffness(w) for w in grid])
    found = []
    for k in np.flatnonzero(np.diff(np.sign(imaginary))):
        w = brentq(lambda w: np.imag(stiffness(w)), grid[k], grid[k + 1])
        if np.real(stiffness(w)) > 0.0 and abs(np.imag(stiffness(w))) < 1.0:
            found.append(np.real(stiffness(w)))
    return min(found)


@pytest.mark.parametrize(("kf", "late_s"), [(2.0, 0.01), (3.0, 0.004)])
def test_boundary_of_small_steps_is_that_of_the_continuous_equation(kf, late_s):
    """To a tick of lateness and half of one of sampling, of 200: a boundary that goes as its square moves by 2 %."""
    dt, damped = late_s / 200, 2e-4
    law = acceleration(TRANSPOSE, A, touch=TOUCH._replace(kf=kf))
    K = late_boundary(kf, late_s, damped)
    assert settles(law, Spring(0.95 * K, 0.95 * damped * K), 199, dt)
    assert not settles(law, Spring(1.05 * K, 1.05 * damped * K), 199, dt)


@pytest.mark.parametrize("K", [1e3, 1e5])
@pytest.mark.parametrize("controller", [TRANSPOSE, INVERSE], ids=["transpose", "inverse"])
def test_without_delay_slow_roots_are_those_of_the_quadratic(K, controller):
    """s^2 + (kc + a B) s + a K is stable by Hurwitz; a is the mobility under the controller."""
    B, dt = 1e-3 * K, 1e-6
    law = acceleration(controller, A)
    seen = law[2] + law[3]
    roots = np.roots([1.0, TOUCH.kc + seen * B, seen * K])
    eigenvalues = np.linalg.eigvals(step(law, Spring(K, B), 0, dt))
    for root in roots:
        assert np.abs(eigenvalues - np.exp(root * dt)).min() <= 2e-2 * abs(root) * dt
    assert settles(law, Spring(K, B), 0, dt)
    assert (roots.real < 0.0).all()


@pytest.mark.parametrize("controller", ["hybrid-base+inverse", "impedance-geometric"])
def test_mujoco_settles_and_does_not_where_theory_says(controller):
    K = stability.boundary(lambda stiffness: stability.predicted(controller, TOUCH.kf, stiffness, 10))
    assert 1e5 < K < 1e6
    assert stability.is_steady(stability.pressed(controller, TOUCH.kf, 0.8 * K, 0.01))
    assert not stability.is_steady(stability.pressed(controller, TOUCH.kf, 1.25 * K, 0.01))
