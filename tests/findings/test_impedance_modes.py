"""Theory of the modes of an impedance without inertia shaping, against one tick of the loop and numpy's poles."""

import functools
import xml.etree.ElementTree as ElementTree

import numpy as np
import pandas as pd
import pytest

import tasks
from bench.experiments.experiment import Unit, rows_of
from bench.experiments.impedance import STIFFNESSES, ZETA
from bench.experiments.impedance_modes import SHIPPED, find_longest_delay
from bench.experiments.request import Request
from bench.findings.theory import impedance_modes as theory
from bench.law.control.unshaped import DAMPINGS
from tasks.kinematics import Kinematics

ARMS = ("panda", "puma560", "ur5e")
DESIGNS = tuple(DAMPINGS)


@functools.cache
def measured(arm: str, damping: str, dt: float = 1e-3) -> pd.DataFrame:
    """Rows of a design on an arm, with theory."""
    unit = Unit("impedance-modes", task="arm-regulation", arm=arm, selector=damping)
    return theory.with_theory(rows_of(Request(dt_s=dt), unit))


@pytest.mark.parametrize("damping", DESIGNS)
@pytest.mark.parametrize("arm", ["jaco", *ARMS])
def test_modes_of_the_loop_are_those_of_the_arms_matrices(arm, damping):
    rows = measured(arm, damping)
    # Differences err by the square of 1e-4 rad times what K J changes by over it. MuJoCo integrates the damping of
    # joints implicitly, as if they had dt B more inertia: with the Jaco's least motors 1e-4 of it.
    np.testing.assert_allclose(rows["omega"], rows["omega_theory"], rtol=1e-4)
    np.testing.assert_allclose(rows["ratio"], rows["ratio_theory"], rtol=1e-4)
    np.testing.assert_allclose(rows["radius"], rows["radius_theory"], rtol=1e-5)
    np.testing.assert_allclose(rows["longest_dt_s"], rows["longest_dt_s_theory"], rtol=1e-4)


@pytest.mark.parametrize("arm", ARMS)
def test_double_diagonalization_damps_every_mode_as_asked_and_other_designs_some_mode_by_less(arm):
    np.testing.assert_allclose(measured(arm, "double-diagonalization")["ratio"], ZETA, rtol=1e-6)
    for damping in ("diagonal", "per-axis"):
        assert measured(arm, damping)["ratio"].min() < 0.9 * ZETA


def test_hand_and_motors_are_those_of_a_model_with_a_body_more():
    arm = tasks.arm("panda")
    root = ElementTree.fromstring(arm.xml)
    more = ElementTree.SubElement(root.find(".//body[@name='tool']"), "body")
    ElementTree.SubElement(more, "inertial", mass=".73", pos="-.01 0 .03", diaginertia=".001 .0025 .0017")
    wanted, found = Kinematics(arm._replace(xml=ElementTree.tostring(root, encoding="unicode"))), Kinematics(arm)
    tasks.variation("nominal").apply(found.model, arm.rated)
    for q in (arm.home, [0.3, -0.5, 0.2, -2.0, 0.4, 1.1, -0.7]):
        D = wanted.inertia_matrix(q) + 0.1 * np.eye(7)
        np.testing.assert_allclose(found.inertia_matrix(q), D, atol=1e-12)


def test_shipped_rule_is_unstable_at_1_khz_only_without_hand_and_motors():
    radius = measured("panda", "diagonal").query("stiffness_n_m == 2000").groupby("variation")["radius"].max()
    assert (list(radius.index[radius > 1.0]), len(radius)) == (["ideal-motors"], 4)


@pytest.mark.parametrize("arm", ARMS)
@pytest.mark.parametrize("damping", DESIGNS)
def test_longest_tick_is_where_the_loop_that_runs_becomes_unstable(arm, damping):
    for stiffness in STIFFNESSES:
        dt = theory.longest_tick(*theory.hand_matrices(theory.hand_of(arm), damping, stiffness, ZETA))
        for share, holds in ((0.99, True), (1.01, False)):
            rows = measured(arm, damping, share * dt)
            rows = rows.query(f"stiffness_n_m == {stiffness.translation} and variation == 'ideal-motors'")
            assert (rows["radius"].max() < 1.0) == holds


def greatest_modulus(P, Q, dt, ticks):
    """Return the greatest |eigenvalue| of places, rates and the commands that wait, each so many ticks late."""
    one, size = np.eye(6), 12 + 6 * ticks
    tick, last = np.eye(size, k=-6), slice(size - 6, size)
    tick[:18] = 0.0
    tick[:6, :6] = tick[6:12, 6:12] = one
    tick[:6, 6:12] = dt * one
    tick[:6, last], tick[6:12, last] = -dt * dt * one, -dt * one
    tick[12:18, :12] = np.hstack((P, Q))
    return np.abs(np.linalg.eigvals(tick)).max()


@pytest.mark.parametrize("damping", DESIGNS)
def test_longest_delay_lies_between_two_whole_numbers_of_ticks(damping):
    dt, hand = 1e-3, theory.hand_of("panda", "nominal")
    P, Q = theory.hand_matrices(hand, damping, (600.0, 50.0), ZETA)
    ticks = int(find_longest_delay(P, Q, dt) / dt)
    assert greatest_modulus(P, Q, dt, ticks) < 1.0 < greatest_modulus(P, Q, dt, ticks + 1)


@pytest.mark.parametrize("arm", ARMS)
def test_longest_delay_is_that_of_continuous_theory(arm):
    rows = measured(arm, "diagonal")
    rows = rows[rows["variation"] != "ideal-motors"]
    # theory takes half a tick for what is a tick in steps: it errs by the square of omega dt, 0.3 with the least motors
    np.testing.assert_allclose(rows["longest_delay_s"], rows["longest_delay_s_theory"], rtol=0.03)


def held_modulus(P, Q, dt, delay):
    """Return the greatest |eigenvalue| of places, rates and past commands over a period of an exact hold."""
    n = len(P)
    whole = int(delay / dt)
    late = delay - whole * dt
    size = 2 * n + n * (whole + 1)
    blocks = np.eye(size).reshape(-1, n, size)
    x, v = blocks[0], blocks[1]
    commands = [-(P @ x + Q @ v), *blocks[2:]]
    for duration, command in ((late, commands[whole + 1]), (dt - late, commands[whole])):
        x = x + duration * v + 0.5 * duration * duration * command
        v = v + duration * command
    period = np.vstack((x, v, *commands[: whole + 1]))
    return np.abs(np.linalg.eigvals(period)).max()


@pytest.mark.parametrize(
    ("omega", "zeta"),
    [(10, 1.0), (20, 1.0), (50, 1.0), (100, 1.0), (300, 1.0), (100, 0.5), (100, 2.0), (50, 4.0), (400, 0.7)],
)
def test_longest_held_delay_of_one_axis_is_that_of_the_eigenvalues(omega, zeta):
    P, Q, dt = np.array([[omega**2.0]]), np.array([[2.0 * zeta * omega]]), 1e-3
    delay = theory.longest_held_delay(P, Q, dt)
    assert held_modulus(P, Q, dt, 0.999 * delay) < 1.0 < held_modulus(P, Q, dt, 1.001 * delay)
    assert all(held_modulus(P, Q, dt, share * delay) < 1.0 for share in np.linspace(0.0, 0.99, 34))


@pytest.mark.parametrize("stiffness", SHIPPED.values(), ids=list(SHIPPED))
def test_longest_held_delay_of_a_hand_is_that_of_the_eigenvalues(stiffness):
    dt = 1e-3
    P, Q = theory.hand_matrices(theory.hand_of("panda", "nominal"), "diagonal", stiffness, ZETA)
    delay = theory.longest_held_delay(P, Q, dt)
    assert held_modulus(P, Q, dt, 0.999 * delay) < 1.0 < held_modulus(P, Q, dt, 1.001 * delay)


@pytest.mark.parametrize("zeta", [0.5, 1.0, 2.0])
def test_longest_held_tick_of_one_axis_is_known_in_closed_form(zeta):
    # Held: z = -1 at q dt = 2, or z on the circle at q = p dt/2. MuJoCo's: z = -1 at 4 - 2 q dt - p dt^2 = 0.
    omega = 100.0
    P, Q = np.array([[omega**2]]), np.array([[2.0 * zeta * omega]])
    q, p = 2.0 * zeta * omega, omega**2
    assert theory.longest_held_tick(P, Q) == pytest.approx(min(2.0 / q, 2.0 * q / p), rel=1e-6)
    assert theory.longest_tick(P, Q) == pytest.approx((np.sqrt(q * q + 4.0 * p) - q) / p, rel=1e-6)


def test_loop_that_is_unstable_without_delay_has_no_longest_delay():
    assert np.isnan(theory.longest_held_delay(np.array([[1e6]]), np.array([[2.1e3]]), 1e-3))
