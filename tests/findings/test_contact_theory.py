"""Theory of contact: a press on a spring, the jamming diagram and modes, each against another way."""

import functools
import itertools

import numpy as np
import pandas as pd
import pytest
from scipy.optimize import brentq, linprog

from bench.experiments.experiment import Settings, Unit, rows_of
from bench.experiments.impedance import STIFFNESSES, ZETA
from bench.findings.theory import contact_stability
from bench.findings.theory import impedance_modes as theory
from bench.findings.theory.contact_stability import Spring, acceleration
from bench.findings.theory.jamming import margin
from bench.law.control.registry import find_controller
from bench.law.control.setpoint import TOUCH
from bench.law.control.unshaped import DAMPINGS
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
    assert contact_stability.settles(law, Spring(0.95 * K, 0.95 * damped * K), 199, dt)
    assert not contact_stability.settles(law, Spring(1.05 * K, 1.05 * damped * K), 199, dt)


@pytest.mark.parametrize("K", [1e3, 1e5])
@pytest.mark.parametrize("controller", [TRANSPOSE, INVERSE], ids=["transpose", "inverse"])
def test_without_delay_slow_roots_are_those_of_the_quadratic(K, controller):
    """s^2 + (kc + a B) s + a K is stable by Hurwitz; a is the mobility under the controller."""
    B, dt = 1e-3 * K, 1e-6
    law = acceleration(controller, A)
    seen = law[2] + law[3]
    roots = np.roots([1.0, TOUCH.kc + seen * B, seen * K])
    eigenvalues = np.linalg.eigvals(contact_stability.step(law, Spring(K, B), 0, dt))
    for root in roots:
        assert np.abs(eigenvalues - np.exp(root * dt)).min() <= 2e-2 * abs(root) * dt
    assert contact_stability.settles(law, Spring(K, B), 0, dt)
    assert (roots.real < 0.0).all()


@pytest.mark.parametrize("controller", ["hybrid-base+inverse", "impedance-geometric"])
def test_mujoco_settles_and_does_not_where_theory_says(controller):
    K = stability.boundary(lambda stiffness: stability.predicted(controller, TOUCH.kf, stiffness, 10))
    assert 1e5 < K < 1e6
    assert stability.is_steady(stability.pressed(controller, TOUCH.kf, 0.8 * K, 0.01))
    assert not stability.is_steady(stability.pressed(controller, TOUCH.kf, 1.25 * K, 0.01))


MU = 0.2


def is_balanced(across: float, turning: float, reach: float) -> bool:
    """Whether forces of any size within their cones hold a peg pushed inwards by 1: it touches at its end and at the
    mouth, on the same side or, askew, on both.

    r = 1: x across, z outwards, moments about y; the peg has gone in by l = 2 mu lambda.
    """
    pushed = np.array((across, -1.0, turning))
    for end, mouth in itertools.product((1.0, -1.0), repeat=2):
        columns = []
        for (side, height), friction in itertools.product(((end, 0.0), (mouth, 2.0 * MU * reach)), (MU, -MU)):
            x, z = -side, friction
            columns.append((x, z, height * x - side * z))
        found = linprog(np.zeros(len(columns)), A_eq=np.array(columns).T, b_eq=-pushed, bounds=(0.0, None))
        if found.status == 0:
            return True
    return False


@pytest.mark.parametrize("reach", [1.1, 4.0])
def test_load_inside_the_diagram_cannot_be_balanced_and_one_outside_can(reach):
    draw, inside = np.random.default_rng(5), 0
    for _ in range(200):
        across, turning = draw.uniform(-1.2, 1.2) / MU, draw.uniform(-1.5, 1.5) * (1.0 + 2.0 * reach)
        size = margin(across, turning, reach, MU)
        if abs(size - 1.0) < 1e-6:
            continue
        inside += size < 1.0
        assert is_balanced(across, turning, reach) == (size > 1.0), (across, turning)
    assert 20 < inside < 180


def test_peg_that_is_not_far_in_may_be_wedged_by_a_load_that_would_slide():
    """lambda < 1: friction cones of the end and of the mouth see each other, and forces between them cost nothing."""
    load = (-3.56, -0.735)
    assert margin(*load, 0.2, MU) < 1.0
    assert is_balanced(*load, 0.2)


ARMS = ("panda", "puma560", "ur5e")
DESIGNS = tuple(DAMPINGS)


@functools.cache
def measured(arm: str, damping: str, dt: float = 1e-3) -> pd.DataFrame:
    """Rows of a design on an arm, with theory."""
    unit = Unit("impedance-modes", task="arm-regulation", arm=arm, selector=damping)
    return theory.with_theory(rows_of(Settings(dt_s=dt), unit))


@pytest.mark.parametrize("damping", DESIGNS)
@pytest.mark.parametrize("arm", ["jaco", *ARMS])
def test_modes_of_the_loop_are_those_of_the_arms_matrices(arm, damping):
    rows = measured(arm, damping)
    # differences err by the square of 1e-4 rad times what K J changes by over it
    np.testing.assert_allclose(rows["omega"], rows["omega_theory"], rtol=1e-5)
    np.testing.assert_allclose(rows["ratio"], rows["ratio_theory"], rtol=1e-4)
    np.testing.assert_allclose(rows["radius"], rows["radius_theory"], rtol=1e-5)


@pytest.mark.parametrize("arm", ARMS)
def test_double_diagonalization_damps_every_mode_as_asked(arm):
    np.testing.assert_allclose(measured(arm, "double-diagonalization")["ratio"], ZETA, rtol=1e-6)


@pytest.mark.parametrize("arm", ARMS)
def test_other_designs_damp_some_mode_by_less_than_asked(arm):
    for damping in ("diagonal", "per-axis"):
        assert measured(arm, damping)["ratio"].min() < 0.9 * ZETA


def test_shipped_rule_is_unstable_on_the_panda_at_1_khz_and_stable_at_2_khz():
    stiff = [measured("panda", "diagonal", dt).query("stiffness_n_m == 2000")["radius"].max() for dt in (1e-3, 5e-4)]
    assert stiff[0] > 1.0 > stiff[1]


def test_slowest_decay_is_that_of_the_poles_of_numpy():
    """Poles of the continuous loop; a tick of 1 ms changes a pole p by some p^2 dt/2."""
    stiffness = STIFFNESSES[0]
    P, Q = theory.hand_matrices("ur5e", "per-axis", stiffness, ZETA)
    poles = np.linalg.eigvals(np.block([[np.zeros((6, 6)), np.eye(6)], [-P, -Q]]))
    decay = measured("ur5e", "per-axis").query("stiffness_n_m == 150")["decay"].iloc[0]
    assert decay == pytest.approx(-poles.real.max(), rel=1e-2)


@pytest.mark.parametrize("arm", ARMS)
@pytest.mark.parametrize("damping", DESIGNS)
def test_longest_tick_is_where_the_loop_that_runs_becomes_unstable(arm, damping):
    for stiffness in STIFFNESSES:
        dt = theory.longest_tick(arm, damping, stiffness, ZETA)
        for share, holds in ((0.99, True), (1.01, False)):
            rows = measured(arm, damping, share * dt).query(f"stiffness_n_m == {stiffness.translation}")
            assert (rows["radius"].max() < 1.0) == holds
