"""Rotations on tuples against scipy's Rotation, and against MuJoCo where the bits must agree."""

import mujoco
import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS, same_bits
from support.states import matrix, of_scipy, rotations, vector

import tasks
from bench.law.so3 import cross, dot, from_quaternion, relative, rotate, rotate_back

# An element is a sum of three products of numbers up to 1: five roundings, EPS/2 each, and as much again in
# the columns given, which are orthonormal only to rounding.
TOLERANCE = 5 * EPS
STARTS = [start for word in tasks.start_set_names() for start in tasks.start_set(word)]
GENERATOR_SEED = 4


@pytest.fixture(scope="module")
def draw():
    return np.random.default_rng(GENERATOR_SEED)


def test_rotation_of_a_quaternion_is_mujocos_bit_for_bit():
    for start in STARTS:
        theirs = np.empty(9)
        mujoco.mju_quat2Mat(theirs, np.array(start.quat_wxyz))
        assert same_bits(matrix(from_quaternion(vector4(start.quat_wxyz))), theirs.reshape(3, 3)), start.id


def test_rotate_is_scipys_apply_and_rotate_back_undoes_it(draw):
    for R in rotations():
        v = vector(draw.normal(size=3))
        size = np.linalg.norm(v)
        turned = rotate(R, v)
        np.testing.assert_allclose(turned, matrix(R) @ v, rtol=0.0, atol=TOLERANCE * size)
        np.testing.assert_allclose(rotate_back(R, turned), v, rtol=0.0, atol=2 * TOLERANCE * size)


def test_relative_is_the_rotation_seen_from_the_goal(draw):
    every = ScipyRotation.random(50, rng=draw), ScipyRotation.random(50, rng=draw)
    for goal, actual in zip(*every, strict=True):
        R_d, R = (of_scipy(r) for r in (goal, actual))
        expected = (goal.inv() * actual).as_matrix()
        np.testing.assert_allclose(matrix(relative(R_d, R)), expected, rtol=0.0, atol=2 * TOLERANCE)


def test_cross_and_dot_are_numpys_bit_for_bit(draw):
    for p, q in draw.normal(size=(50, 2, 3)):
        assert same_bits(cross(vector(p), vector(q)), np.cross(p, q))
        assert dot(vector(p), vector(q)) == p[0] * q[0] + p[1] * q[1] + p[2] * q[2]


def vector4(quat_wxyz) -> tuple:
    return tuple(np.float64(x) for x in quat_wxyz)
