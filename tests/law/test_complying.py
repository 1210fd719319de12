"""Control in contact by formula: impedances, damping without inertia shaping, and `comply` for every selection."""

import itertools
from typing import NamedTuple

import numpy as np
import pytest
from scipy.linalg import sqrtm
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS
from support.in_contact import GAINS, SELECTIONS, TOUCH, backward, damping
from support.springs import STILL, command, of

from bench.engines.arm_episode import buffers
from bench.engines.contact_episode import room, rows
from bench.law.chain import Chain
from bench.law.control.contact_controller import ACCELERATION_FORMS, FORMS, PAPERS_FORM, SELECTION_ORDERS
from bench.law.control.hybrid import comply
from bench.law.control.setpoint import Rows
from bench.law.control.unshaped import DAMPINGS

HALF_TURN = np.pi
SPRING_OF = {
    "geometric": np.sin,
    "quaternion": lambda theta: 2.0 * np.sin(theta / 2.0),
    "rotation-vector": lambda theta: theta,
}
in_words = pytest.mark.parametrize("word", SPRING_OF)


@pytest.fixture
def draw():
    return np.random.default_rng(51)


def turned(draw):
    """(angle, axis, R, R_d): turned from the goal by every angle up to the half turn, about an axis of the base."""
    for theta in (1e-12, 1e-6, 1e-3, 0.1, 1.0, 2.0, 3.0, HALF_TURN - 1e-6):
        goal, axis = ScipyRotation.random(rng=draw), draw.normal(size=3)
        axis /= np.linalg.norm(axis)
        yield theta, axis, ScipyRotation.from_rotvec(theta * axis) * goal, goal


@in_words
def test_spring_pulls_back_by_its_function_of_the_angle_a_moment_acts_by_the_inertia_and_the_rate_is_damped(word, draw):
    for theta, axis, turn, goal in turned(draw):
        for omega, m in (np.zeros((2, 3)), draw.normal(size=(2, 3))):
            u = command(of(word), turn, omega, m, goal)
            wanted = -GAINS.kp * SPRING_OF[word](theta) * axis + m / TOUCH.m_o - GAINS.kv * omega
            # the rotations given are orthonormal to some EPS, and the axis of a turn near pi is known to as much
            np.testing.assert_allclose(u, wanted, rtol=0.0, atol=40 * EPS * GAINS.kp)


def test_half_turn_leaves_the_geometric_spring_nothing_and_the_others_all_they_have(draw):
    for axis in (*np.eye(3), *draw.normal(size=(5, 3))):
        turn = ScipyRotation.from_rotvec(HALF_TURN * axis / np.linalg.norm(axis))
        for word, spring in SPRING_OF.items():
            u = command(of(word), turn, STILL, STILL, ScipyRotation.identity())
            assert abs(np.linalg.norm(u) - GAINS.kp * spring(HALF_TURN)) <= 40 * EPS * GAINS.kp
            np.testing.assert_allclose(
                np.cross(u, axis), 0.0, rtol=0.0, atol=40 * EPS * GAINS.kp * np.linalg.norm(axis)
            )


RNG = np.random.default_rng(11)


def inertias():
    """Twenty symmetric positive definite ones, of condition numbers up to 1e4."""
    for power in np.linspace(0.0, 4.0, 20):
        U, _ = np.linalg.qr(RNG.normal(size=(6, 6)))
        yield (U * np.geomspace(1.0, 10.0**-power, 6)) @ U.T


def designed(name: str, K: np.ndarray, Lambda: np.ndarray, zeta: float = 0.7) -> np.ndarray:
    """D as the design writes it into a buffer that held something else."""
    D = np.full((7, 7), np.nan)
    DAMPINGS[name].design(K, Lambda, zeta, D, buffers(7).scratch)
    return D[:6, :6]


CASES = [(RNG.uniform(5.0, 3000.0, 6), Lambda) for Lambda in inertias()]


@pytest.mark.parametrize("name", DAMPINGS)
def test_damping_is_symmetric_takes_energy_grows_with_the_ratio_and_is_the_root_on_an_inertia_of_one(name):
    for K, Lambda in CASES:
        D = designed(name, K, Lambda)
        np.testing.assert_allclose(D, D.T, rtol=1e-12, atol=1e-12 * np.abs(D).max())
        assert np.linalg.eigvalsh(D).min() > 0.0
    K = CASES[0][0]
    np.testing.assert_allclose(designed(name, K, np.eye(6)), np.diag(1.4 * np.sqrt(K)), rtol=1e-12, atol=1e-11)
    K, Lambda = CASES[7]
    kept = K.copy(), Lambda.copy()
    np.testing.assert_allclose(designed(name, K, Lambda, 1.4), 2.0 * designed(name, K, Lambda, 0.7), rtol=1e-13)
    np.testing.assert_array_equal(kept[0], K)
    np.testing.assert_array_equal(kept[1], Lambda)


def test_double_diagonalization_is_twice_the_ratio_times_the_geometric_mean():
    """K^1/2 (K^-1/2 Lambda K^-1/2)^1/2 K^1/2, by scipy's root of a matrix."""
    for K, Lambda in CASES:
        k = np.diag(np.sqrt(K))
        inside = np.linalg.solve(k, np.linalg.solve(k, Lambda).T)
        mean = k @ np.real(sqrtm(inside)) @ k
        np.testing.assert_allclose(
            designed("double-diagonalization", K, Lambda), 1.4 * mean, rtol=1e-7, atol=1e-8 * mean.max()
        )


IN_FORMS = pytest.mark.parametrize("form", [*ACCELERATION_FORMS, PAPERS_FORM])
ON_JOINTS = pytest.mark.parametrize("n", [6, 7])


class Given(NamedTuple):
    """What `comply` is given, drawn."""

    J: np.ndarray
    D: np.ndarray
    fg: np.ndarray
    qdot: np.ndarray
    rows: Rows


def given(n: int, count: int = 6):
    """So many; J with a condition of some tens."""
    draw = np.random.default_rng(31)
    while count:
        J, root = draw.normal(size=(6, n)), draw.normal(size=(n, n))
        if np.linalg.cond(J) > 50.0:
            continue
        count -= 1
        into = rows()
        for row in into:
            row[:] = draw.normal(scale=5.0, size=6)
        yield Given(J, root @ root.T + np.eye(n), draw.normal(size=n), draw.normal(size=n), into)


def complied(form: str, held, at: Given):
    """tau of `comply`."""
    n = len(at.fg)
    about, tau = room(), np.full(n, np.nan)
    for buffer in (about.y, about.b, about.x, about.held, *about.scratch):
        buffer[...] = np.nan
    chain = Chain(n, None, None, at.qdot, None, None)
    comply(FORMS.index(form), held, chain, at.D, at.fg, at.J, at.rows, GAINS, TOUCH, about, tau)
    return tau


def inverse(at: Given) -> np.ndarray:
    """J^#, n x 6: the dynamically consistent one, D^-1 J^T Lambda; on six joints J^-1."""
    if len(at.fg) == 6:
        return np.linalg.inv(at.J)
    weighed = np.linalg.solve(at.D, at.J.T)
    return weighed @ np.linalg.inv(at.J @ weighed)


def size(form: str, at: Given) -> float:
    """No y is longer [rad/s^2]."""
    into = at.rows
    along = np.linalg.norm([answer(form, into), into.a, into.drift]) + np.linalg.norm(at.J @ damping(at.qdot))
    return np.linalg.norm(inverse(at), 2) * along + np.linalg.norm(damping(at.qdot))


def answer(form, into) -> np.ndarray:
    """What is commanded where the hand complies: m_p is of x, y, z, m_o of the turns, kc of all."""
    driven = 0.0 if form == PAPERS_FORM else (into.F + into.h) / np.repeat((TOUCH.m_p, TOUCH.m_o), 3)
    return driven - TOUCH.kc * into.v


def exerted(form, held, into) -> np.ndarray:
    """w: the measured wrench cancelled, or what is to be exerted and its error where the hand complies."""
    if form == PAPERS_FORM:
        return (1.0 - np.array(held)) * (into.h + TOUCH.kf * (into.h + into.F))
    return -into.F


def by_formula(form: str, held, at: Given) -> np.ndarray:
    """y: see the docstring of bench.law.control.hybrid."""
    S, left, into, z = np.diag(held), np.eye(6) - np.diag(held), at.rows, damping(at.qdot)
    through = inverse(at)
    complies = through @ left @ (answer(form, into) - into.drift - at.J @ z)
    holds = S @ (into.a - into.drift - at.J @ z)
    return complies + (np.linalg.pinv(S @ at.J) if form == "projected" else through) @ holds + z


@IN_FORMS
@ON_JOINTS
def test_torques_are_the_formula_for_every_selection(n, form):
    for at, held in itertools.product(given(n), SELECTIONS):
        wanted, w = by_formula(form, held, at), exerted(form, held, at.rows)
        sizes = np.linalg.norm(at.D, 2) * size(form, at) + np.linalg.norm(at.J, 2) * np.linalg.norm(w)
        allowed = backward(at.J) * np.linalg.cond(at.D) * sizes  # normal equations with J and with D
        tau = complied(form, held, at)
        np.testing.assert_allclose(tau, at.D @ wanted + at.fg + at.J.T @ w, rtol=0.0, atol=allowed, err_msg=held)


@pytest.mark.parametrize("form", SELECTION_ORDERS)
@ON_JOINTS
def test_torques_of_both_orders_of_selection_are_the_formula_for_every_selection(n, form):
    """W = Lambda S a, of the second order S Lambda S a, and C h; tau = J^T (W - Lambda (drift + J z)) + D z + fg."""
    for at, held in itertools.product(given(n), SELECTIONS):
        S, z = np.diag(held), damping(at.qdot)
        Lambda = np.linalg.inv(at.J @ np.linalg.solve(at.D, at.J.T))
        moved = Lambda @ S @ at.rows.a
        wrench = moved if form == "selected-then-decoupled" else S @ moved
        wrench = wrench + (np.eye(6) - S) @ at.rows.h - Lambda @ (at.rows.drift + at.J @ z)
        sizes = np.linalg.norm(at.D, 2) * size(form, at) + np.linalg.norm(at.J, 2) * np.linalg.norm(wrench)
        allowed = backward(at.J) * np.linalg.cond(at.D) * sizes  # normal equations with J and with D
        wanted = at.J.T @ wrench + at.D @ z + at.fg
        np.testing.assert_allclose(complied(form, held, at), wanted, rtol=0.0, atol=allowed, err_msg=held)
