"""Impedances by scipy's rotations and closed forms; designs of damping without inertia shaping by scipy's root."""

import numpy as np
import pytest
from scipy.linalg import sqrtm
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS
from support.in_contact import GAINS, TOUCH
from support.springs import STILL, command, of

from bench.engines.arm_episode import buffers
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
