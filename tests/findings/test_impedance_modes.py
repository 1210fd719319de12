"""Theory of the modes of an impedance without inertia shaping, against one tick of the loop and numpy's poles."""

import functools

import numpy as np
import pandas as pd
import pytest

from bench.experiments.experiment import Settings, Unit, rows_of
from bench.experiments.impedance import STIFFNESSES, ZETA
from bench.findings.theory import impedance_modes as theory
from bench.law.control.unshaped import DAMPINGS

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
