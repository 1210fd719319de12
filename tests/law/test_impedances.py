"""What each impedance is, by scipy's rotations and closed forms."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS
from support.in_contact import GAINS, TOUCH
from support.springs import STILL, command, of

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
