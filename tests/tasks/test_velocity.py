"""The judge's plants commanded by velocities, beside scipy's rotations and exponentials of matrices."""

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

from tasks.velocity import followed, servo, turned


@pytest.mark.parametrize("angle", [1e-12, 1e-9, 1e-8, 1e-3, 1.0, 3.1, 7.0])
def test_turned_quaternion_is_scipys(angle):
    rng = np.random.default_rng(3)
    for _ in range(20):
        quat, axis = Rotation.random(rng=rng), rng.normal(size=3)
        turn = angle * axis / np.linalg.norm(axis)
        found = turned(tuple(quat.as_quat(scalar_first=True)), tuple(turn))
        expected = (Rotation.from_rotvec(turn) * quat).as_matrix()
        np.testing.assert_allclose(Rotation.from_quat(found, scalar_first=True).as_matrix(), expected, atol=2e-15)
        assert np.linalg.norm(found) == pytest.approx(1.0, abs=3e-16)


def test_no_turn_keeps_every_bit():
    quat = (0.0, 0.6, 0.0, 0.8)
    assert turned(quat, (0.0, 0.0, 0.0)) is quat


@pytest.mark.parametrize("lag", [1e-4, 1e-3, 0.05, 2.0])
def test_servo_with_lag_is_the_exponential_of_its_matrix(lag):
    dt, command, rate = 0.01, 0.7, -0.4
    matrix = np.array([[0.0, 1.0, 0.0], [0.0, -1.0 / lag, 1.0 / lag], [0.0, 0.0, 0.0]])  # of (angle, rate, command)
    expected = expm(dt * matrix) @ (0.0, rate, command)
    np.testing.assert_allclose(followed(rate, command, servo(dt, lag)), expected[:2], rtol=1e-12, atol=1e-15)


def test_servo_without_lag_follows_at_once():
    assert followed(-0.4, 0.7, servo(0.01, 0.0)) == (pytest.approx(0.007), 0.7)
