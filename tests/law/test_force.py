"""Controllers in contact against MuJoCo's forward dynamics, and by the work they do.

B and its derivative are those of `exact`, differentiated with 80 digits.
"""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS
from support.exact import exact_B, motion
from support.in_contact import (
    ARMS,
    GAINS,
    HYBRIDS,
    IMPEDANCES,
    SELECTIONS,
    TOUCH,
    backward,
    drawn,
    felt,
    hand,
    tick,
)
from support.states import vector

import tasks
from bench.law.contender import axes_of, bind
from bench.law.control.contact_controller import PAPERS_FORM, SELECTION_ORDERS
from bench.law.control.setpoint import TOUCH as TOUCHING
from tasks.contact import Specification

INERTIA = np.array([TOUCH.m_p] * 3 + [TOUCH.m_o] * 3)
UNCONVERTED = [one for one in HYBRIDS if not one.converts]
# Sums of a few products of numbers that carry the rounding of n rotations each.
ROUNDING = 200 * EPS


over_arms = pytest.mark.parametrize("arm", ARMS)


def B_of(representation, E) -> np.ndarray:
    return np.array(exact_B(representation.to_matrix, E).tolist(), dtype=float)


def frame(one, at, setpoint) -> tuple[np.ndarray, np.ndarray]:
    """(M, bent): its rows' velocity is M (pdot, omega), their acceleration M (pddot, omegadot) - bent."""
    M, bent = np.eye(6), np.zeros(6)
    if one.law == "hybrid-hand":
        M = np.kron(np.eye(2), (at.R @ np.array(setpoint.R_d)).T)  # Q = R R_d^T; np.array(R_d) is R_d^T
    elif one.representation is not None:
        E = one.representation.chart(at.chain.R).E
        B = B_of(one.representation, E)
        Edot = np.linalg.solve(B, at.velocity[3:])
        M[3:, 3:] = np.linalg.inv(B)
        bent[3:] = np.linalg.solve(B, np.array(motion(one.representation.to_matrix, E, Edot)[1], dtype=float))
    return M, bent


def commanded(one, at, setpoint, held) -> np.ndarray:
    """The acceleration along its rows; of `transpose` that and what the wrenches make of the hand."""
    M, _ = frame(one, at, setpoint)
    velocity, into_frame = M @ at.velocity, np.linalg.inv(M).T
    spring = GAINS.kp * (np.array(setpoint.p_d) - at.chain.p) + GAINS.kv * (np.array(setpoint.v_d) - at.velocity[:3])
    f_d, m_d = np.array(setpoint.f_d), np.array(setpoint.m_d)
    if one.representation is not None:
        E, E_d = (np.array(one.representation.chart(R).E) for R in (at.chain.R, setpoint.R_d))
        a = np.concatenate((spring, GAINS.kp * (E_d - E) - GAINS.kv * velocity[3:]))
        h = into_frame @ np.concatenate((f_d, m_d))
    else:
        turn = (ScipyRotation.from_matrix(np.array(setpoint.R_d).T) * ScipyRotation.from_matrix(at.R).inv()).as_rotvec()
        stiff = 0.0 if one.law == "hybrid-rate" else GAINS.kp * np.sinc(np.linalg.norm(turn) / np.pi)
        a = M @ np.concatenate((spring, stiff * turn - GAINS.kv * at.velocity[3:]))
        h = np.concatenate((f_d, m_d))
    F = into_frame @ at.F
    if one.form in SELECTION_ORDERS:
        return by_selection_order(one.form, mobility(at, M), np.where(held, a, 0.0), np.where(held, 0.0, h), held) + (
            mobility(at, M) @ F
        )
    if one.form == PAPERS_FORM:
        exerted = np.where(held, 0.0, h + TOUCH.kf * (h + F))
        return np.where(held, a, -TOUCH.kc * velocity) + mobility(at, M) @ (F + exerted)
    return np.where(held, a, (F + h) / INERTIA - TOUCH.kc * velocity)


def by_selection_order(form, mobility, a, h, held) -> np.ndarray:
    """The acceleration along rows that the wrench of an order of selection makes of a hand that nothing touches."""
    wrench = np.linalg.solve(mobility, a)
    if form == "decoupled-then-selected":
        wrench = np.where(held, wrench, 0.0)
    return mobility @ (wrench + h)


def mobility(at, M) -> np.ndarray:
    """Acceleration along rows per force along them: M J D^-1 J^T M^T."""
    return M @ at.J @ np.linalg.solve(at.D, (M @ at.J).T)


def some_selections():
    draw = np.random.default_rng(32)
    return [SELECTIONS[0], SELECTIONS[-1], *(SELECTIONS[i] for i in draw.integers(64, size=4))]


def rounding(at, J) -> float:
    """Relative error of an acceleration of the hand: what is solved with J, and MuJoCo's forward dynamics with D."""
    return backward(J) + 36 * EPS * np.linalg.cond(at.D)


def sizes(at, M, bent) -> float:
    """What is added up to an acceleration along rows: that of the joints, that of the wrench, the drift."""
    joints = np.linalg.norm(at.data.qacc) + np.linalg.norm(np.linalg.solve(at.D, at.J.T @ at.F))
    return np.linalg.norm(M, 2) * (np.linalg.norm(at.J, 2) * joints + np.linalg.norm(at.drift)) + np.linalg.norm(bent)


@over_arms
def test_wrench_that_is_felt_is_the_one_applied_moved_to_the_hands_frame(arm):
    for state, _ in drawn(arm):
        at = hand(*state)
        np.testing.assert_allclose(np.concatenate(felt(at)), at.F, rtol=0.0, atol=ROUNDING * np.linalg.norm(at.F))


@over_arms
@pytest.mark.parametrize("one", [one for one in HYBRIDS if one.converts])
def test_perfect_model_gives_the_hand_the_commanded_acceleration(arm, one):
    """MuJoCo's J qacc + Jdot qdot under the wrench in the controller's frame: all rows; of `projected` what is held."""
    compared = 0
    for state, setpoint in drawn(arm):
        at = hand(*state)
        if one.representation is not None and one.representation.margin(at.chain.R) <= 0.2:
            continue
        M, bent = frame(one, at, setpoint)
        for held in some_selections():
            made = tick(one, at, setpoint, held)
            got = M @ at.acceleration(made.tau) - bent
            wanted = commanded(one, at, setpoint, held)
            if one.form == "projected" and not all(x == 0.0 for x in held):
                got, wanted = got[np.array(held) > 0.0], wanted[np.array(held) > 0.0]
            allowed = rounding(at, M @ at.J) * sizes(at, M, bent)
            np.testing.assert_allclose(got, wanted, rtol=0.0, atol=allowed, err_msg=held)
            compared += 1
    assert compared >= 12


@over_arms
@pytest.mark.parametrize("one", IMPEDANCES)
def test_perfect_model_gives_the_hand_the_acceleration_of_the_impedance(arm, one):
    """p as a mass, damper and spring; the turn as the law says."""
    compared = 0
    for state, setpoint in drawn(arm):
        at = hand(*state)
        law = bind(one.impedance, one.representation)
        f_d, m_d = np.array(setpoint.f_d), np.array(setpoint.m_d)
        u = law(at.chain.R, vector(at.velocity[3:]), vector(at.F[3:] + m_d), setpoint.R_d, GAINS, TOUCH.m_o)
        if np.linalg.norm(u) > 1e3:
            continue  # beside a pole of its coordinates
        pddot = GAINS.kp * (np.array(setpoint.p_d) - at.chain.p) + GAINS.kv * (np.array(setpoint.v_d) - at.velocity[:3])
        wanted = np.concatenate((pddot + (at.F[:3] + f_d) / TOUCH.m_p, u))
        got = at.acceleration(tick(one, at, setpoint, one.selection(None)).tau)
        allowed = rounding(at, at.J) * sizes(at, np.eye(6), np.zeros(6)) + ROUNDING * 20 * np.linalg.norm(u)
        np.testing.assert_allclose(got, wanted, rtol=0.0, atol=allowed)
        compared += 1
    assert compared >= 4


@pytest.mark.parametrize("one", UNCONVERTED)
def test_unconverted_moments_are_their_components_about_the_axes_that_the_coordinates_stand_for(one):
    for state, setpoint in drawn(ARMS[0]):
        at = hand(*state)
        into = tick(one, at, setpoint, SELECTIONS[0]).rows
        _, m = felt(at)
        for row, moment in ((into.F, m), (into.h, setpoint.m_d)):
            assert tuple(row[3 + k] for k in axes_of(one.representation)) == tuple(moment)


@over_arms
def test_apparent_inertias_are_above_half_of_the_hands_own_at_home(arm):
    """Below that a cancelled force, which comes a tick late, would destabilize a contact (control.setpoint.TOUCH)."""
    at = hand(arm, tasks.arm(arm).home, np.zeros(tasks.arm(arm).joints), ScipyRotation.identity(), np.zeros(6))
    mobility = at.J @ np.linalg.solve(at.D, at.J.T)
    assert 0.5 / np.linalg.eigvalsh(mobility[:3, :3]).min() < TOUCHING.m_p
    assert 0.5 / np.linalg.eigvalsh(mobility[3:, 3:]).min() < TOUCHING.m_o


@pytest.mark.parametrize("one", HYBRIDS)
def test_each_axis_of_an_order_selects_the_row_that_moves_along_it(one):
    """Near the origin of its coordinates a row's motion is along or about that axis, more than any other row's."""
    near = (0.01, 0.02, 0.03)
    M = np.eye(6)
    if one.representation is not None:
        B = B_of(one.representation, near)
        M[3:, 3:] = B / np.linalg.norm(B, axis=0)
    for axis in range(6):
        held = one.selection(Specification("", tuple(int(k != axis) for k in range(6))))
        [row] = [k for k in range(6) if held[k] == 0.0]
        assert abs(M[axis, row]) == pytest.approx(np.abs(M[axis]).max(), rel=1e-3)


@pytest.mark.parametrize("one", IMPEDANCES)
def test_impedance_holds_every_row_whatever_the_order(one):
    assert one.selection(Specification("", (0,) * 6)) == (1.0,) * 6
