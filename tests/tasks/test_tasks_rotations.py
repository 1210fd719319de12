"""Quaternions of the starts against scipy's rotations and MuJoCo's matrices, exact points included."""

import math

import mujoco
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tasks.rotations import about, columns, multiply, on_pole, short_of_180_degrees, to_body, zyx

SEED = 11
# Entries of R are sums of four products of numbers below 1: a few 2^-53.
ROUNDING = 1e-15


def matrix(quat):
    return np.array(columns(quat)).T


def scipy_matrix(quat):
    return Rotation.from_quat(quat, scalar_first=True).as_matrix()


def random_angles(count):
    u = np.random.default_rng(SEED).uniform(-1.0, 1.0, size=(count, 3))
    return (u * [math.pi, math.pi / 2, math.pi]).tolist()


def random_quats(count):
    quats = np.random.default_rng(SEED).normal(size=(count, 4))
    return [tuple(q) for q in (quats / np.linalg.norm(quats, axis=1, keepdims=True)).tolist()]


def test_columns_are_those_of_mujoco_bit_for_bit():
    out = np.zeros(9)
    for quat in random_quats(200):
        mujoco.mju_quat2Mat(out, np.array(quat))
        assert np.array_equal(matrix(quat), out.reshape(3, 3))


def test_product_composes_rotations():
    for p, q in zip(random_quats(50), reversed(random_quats(50)), strict=True):
        np.testing.assert_allclose(matrix(multiply(p, q)), scipy_matrix(p) @ scipy_matrix(q), atol=ROUNDING)


def test_body_coordinates_are_the_transposed_matrix_times_a_vector():
    vector = (0.3, -2.0, 5.0)
    for quat in random_quats(50):
        np.testing.assert_allclose(to_body(quat, vector), scipy_matrix(quat).T @ vector, atol=1e-14)


def test_zyx_agrees_with_scipy():
    for angles in random_angles(200):
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


@pytest.mark.parametrize("delta", [1.0, 1e-3, 1e-9, 1e-12])
def test_short_of_180_degrees_agrees_with_scipy(delta):
    axis = np.array([1.0, -2.0, 0.5])
    expected = Rotation.from_rotvec((math.pi - delta) * axis / np.linalg.norm(axis)).as_matrix()
    np.testing.assert_allclose(matrix(short_of_180_degrees(tuple(axis), delta)), expected, atol=ROUNDING)


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
