"""Quaternions of starts, the judge's angle and haversine against scipy and MuJoCo, exact points included."""

import math
from fractions import Fraction

import mujoco
import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.states import rotation

from bench.engines.compiled import compile_on_demand
from tasks.base import IDENTITY, angle, haversine
from tasks.rotations import about, columns, multiply, on_pole, short_of_180_degrees, to_body, zyx

SEED = 11
# Entries of R are sums of four products of numbers below 1: a few 2^-53.
ROUNDING = 1e-15


def matrix(quat):
    return np.array(columns(quat)).T


def random_quats(count, seed=SEED):
    quats = np.random.default_rng(seed).normal(size=(count, 4))
    return [tuple(q) for q in (quats / np.linalg.norm(quats, axis=1, keepdims=True)).tolist()]


def test_columns_are_those_of_mujoco_bit_for_bit():
    out = np.zeros(9)
    for quat in random_quats(200):
        mujoco.mju_quat2Mat(out, np.array(quat))
        assert np.array_equal(matrix(quat), out.reshape(3, 3))


def test_product_composes_rotations():
    for p, q in zip(random_quats(50), reversed(random_quats(50)), strict=True):
        np.testing.assert_allclose(matrix(multiply(p, q)), (rotation(p) * rotation(q)).as_matrix(), atol=ROUNDING)


def test_body_coordinates_are_the_transposed_matrix_times_a_vector():
    vector = (0.3, -2.0, 5.0)
    for quat in random_quats(50):
        np.testing.assert_allclose(to_body(quat, vector), rotation(quat).inv().apply(vector), atol=1e-14)


def test_zyx_agrees_with_scipy():
    u = np.random.default_rng(SEED).uniform(-1.0, 1.0, size=(200, 3))
    for angles in (u * [math.pi, math.pi / 2, math.pi]).tolist():
        expected = Rotation.from_euler("ZYX", angles).as_matrix()
        np.testing.assert_allclose(matrix(zyx(*angles)), expected, rtol=0, atol=ROUNDING)


def test_zyx_is_exact_at_quarter_and_half_turns():
    assert zyx(math.pi, 0.0, 0.0) == (0.0, 0.0, 0.0, 1.0)
    assert zyx(0.0, 0.0, -math.pi) == (0.0, -1.0, 0.0, 0.0)
    assert matrix(zyx(math.pi / 2, 0.0, 0.0))[0, 0] == 0.0


def test_about_agrees_with_scipy():
    for axis in np.random.default_rng(SEED).normal(size=(50, 3)).tolist():
        for theta in (1e-9, 0.5, 2.0, math.pi):
            expected = Rotation.from_rotvec(theta * np.array(axis) / np.linalg.norm(axis)).as_matrix()
            np.testing.assert_allclose(matrix(about(tuple(axis), theta)), expected, atol=ROUNDING)


def test_half_turn_has_a_symmetric_matrix_about_any_axis():
    for axis in np.random.default_rng(SEED).normal(size=(50, 3)).tolist():
        R = matrix(short_of_180_degrees(tuple(axis), 0.0))
        assert np.array_equal(R, R.T)


@pytest.mark.parametrize("sign", [1, -1])
def test_pole_has_n_exactly_along_z_and_its_twist(sign):
    for twist in (0.0, *np.linspace(0.2, 2.9, 28), *np.linspace(-2.9, -0.2, 28), math.pi / 2, math.pi, -math.pi):
        quat = on_pole(sign, twist)
        n = columns(quat)[0]
        assert n[:2] == (0.0, 0.0)
        assert abs(n[2] + sign) <= 2**-52
        expected = Rotation.from_euler("ZYX", [twist, sign * math.pi / 2, 0.0]).as_matrix()
        np.testing.assert_allclose(matrix(quat), expected, atol=1e-14)


def test_pole_is_refused_when_the_twist_is_too_small_for_doubles():
    with pytest.raises(ArithmeticError, match=r"no double near twist = 0\.006"):
        on_pole(1, 0.006)


def test_angle_agrees_with_scipy_over_uniform_pairs():
    for quat, goal in zip(random_quats(300), random_quats(300, SEED + 1), strict=True):
        expected = (rotation(goal).inv() * rotation(quat)).magnitude()
        assert angle(quat, goal) == pytest.approx(expected, abs=ROUNDING * 4)


@pytest.mark.parametrize("size", [1e-15, 1e-12, 1e-9, 1e-8, 1e-4, 1e-3, 1e-1, 1.0])
def test_angle_keeps_its_digits_near_0_and_near_180_degrees_which_are_scipys(size):
    for axis in np.random.default_rng(SEED).normal(size=(20, 3)):
        assert angle(about(tuple(axis.tolist()), size), IDENTITY) == pytest.approx(size, rel=1e-14)
        quat = short_of_180_degrees(tuple(axis.tolist()), size)
        expected = Rotation.from_rotvec((math.pi - size) * axis / np.linalg.norm(axis)).as_matrix()
        np.testing.assert_allclose(matrix(quat), expected, atol=ROUNDING)
        assert angle(quat, IDENTITY) == pytest.approx(math.pi - size, abs=ROUNDING)
        assert 1.0 - haversine(quat, IDENTITY) == pytest.approx(math.sin(size / 2) ** 2, rel=1e-2, abs=2**-52)


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
    for function in (angle, haversine):
        compiled = compile_on_demand(function)
        for quat, goal in zip(random_quats(100), random_quats(100, SEED + 1), strict=True):
            assert compiled(quat, goal) == function(quat, goal)
