"""The judge's angle and haversine against scipy's rotations and against known rotations."""

import math
from fractions import Fraction

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tasks.base import angle, haversine
from tasks.rotations import about, short_of_180_degrees

IDENTITY = (1.0, 0.0, 0.0, 0.0)
SEED = 7
# Products of unit quaternions round to a few 2^-53 in each part; the angle is twice an angle of them.
ROUNDING = 1e-15


def random_quats(count, seed=SEED):
    quats = np.random.default_rng(seed).normal(size=(count, 4))
    return [tuple(q) for q in (quats / np.linalg.norm(quats, axis=1, keepdims=True)).tolist()]


def scipy_rotation(quat):
    return Rotation.from_quat(quat, scalar_first=True)


def test_angle_agrees_with_scipy_over_uniform_pairs():
    for quat, goal in zip(random_quats(300), random_quats(300, SEED + 1), strict=True):
        expected = (scipy_rotation(goal).inv() * scipy_rotation(quat)).magnitude()
        assert angle(quat, goal) == pytest.approx(expected, abs=ROUNDING * 4)


@pytest.mark.parametrize("theta", [1e-15, 1e-12, 1e-8, 1e-4, 1e-1])
def test_angle_keeps_its_digits_when_near_identity(theta):
    for axis in np.random.default_rng(SEED).normal(size=(20, 3)).tolist():
        assert angle(about(tuple(axis), theta), IDENTITY) == pytest.approx(theta, rel=1e-14)


@pytest.mark.parametrize("delta", [1e-15, 1e-12, 1e-8, 1e-4, 1e-1])
def test_angle_keeps_its_digits_when_near_half_turn(delta):
    for axis in np.random.default_rng(SEED).normal(size=(20, 3)).tolist():
        quat = short_of_180_degrees(tuple(axis), delta)
        assert angle(quat, IDENTITY) == pytest.approx(math.pi - delta, abs=ROUNDING)
        assert 1.0 - haversine(quat, IDENTITY) == pytest.approx((delta / 2) ** 2, rel=1e-2, abs=2**-52)


def test_angle_is_pi_when_exactly_half_turn():
    for quat in ((0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0), (0.0, 0.6, 0.0, 0.8)):
        assert angle(quat, IDENTITY) == math.pi
        assert haversine(quat, IDENTITY) == 1.0


def test_angle_is_zero_at_the_goal_and_ignores_the_sign_of_a_quaternion():
    for quat, goal in zip(random_quats(50), random_quats(50, SEED + 1), strict=True):
        opposite = tuple(-x for x in quat)
        assert angle(quat, quat) < ROUNDING
        assert haversine(quat, quat) < ROUNDING**2
        assert angle(opposite, goal) == angle(quat, goal)
        assert haversine(opposite, goal) == haversine(quat, goal)


def test_haversine_is_the_rational_value():
    def exact(quat, goal):
        (w, x, y, z), (a, b, c, d) = (tuple(map(Fraction, q)) for q in (quat, goal))
        scalar = a * w + b * x + c * y + d * z
        return 1 - scalar**2 / ((w * w + x * x + y * y + z * z) * (a * a + b * b + c * c + d * d))

    for quat, goal in zip(random_quats(100), random_quats(100, SEED + 1), strict=True):
        assert haversine(quat, goal) == pytest.approx(float(exact(quat, goal)), abs=ROUNDING)


def test_truth_compiles_unchanged():
    numba = pytest.importorskip("numba")
    for function in (angle, haversine):
        compiled = numba.njit(error_model="numpy")(function)
        for quat, goal in zip(random_quats(100), random_quats(100, SEED + 1), strict=True):
            assert compiled(quat, goal) == function(quat, goal)
