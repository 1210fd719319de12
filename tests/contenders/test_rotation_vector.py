"""The rotation vector against scipy, matrix exponentials and closed forms of 50 digits, from 1e-300 to a half turn."""

import math

import mpmath
import numpy as np
import pytest
from scipy.linalg import expm
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS
from support.states import as_rotation, rotations, vector

import tasks
from bench.contenders.registry import find_contender, representation
from bench.contenders.representations.rotation_vector import FLAT, NEAR, coefficients, slopes
from bench.law.contender import AT_REST, Gains, Goal
from tasks.rotations import columns

VECTOR = representation("rotation-vector")
# The bound of test_every_representation: sums of three products of up to three rounded factors.
TOLERANCE = 10 * EPS
ANGLES = (
    *(10.0**-k for k in range(13)),
    *(math.sqrt(edge) * side for edge in (FLAT, NEAR) for side in (1 - 1e-9, 1.0, 1 + 1e-9)),
    *(2.0, 3.0),
    *(math.pi - 10.0**-k for k in range(1, 16)),
    math.pi,
)
AXES = np.array([*np.eye(3), (0.36, -0.48, 0.8), (-0.6, 0.64, 0.48)])


def skew(v):
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def left_jacobian(phi):
    """The integral of exp(s [phi]x) over s from 0 to 1, as a block of one matrix exponential."""
    block = np.zeros((6, 6))
    block[:3, :3], block[:3, 3:] = skew(phi), np.eye(3)
    return expm(block)[:3, 3:]


def matrix_of(kernel, at):
    return np.array([kernel(at, vector(unit)) for unit in np.eye(3)]).T


def test_vector_is_scipys_everywhere_but_for_the_sign_of_half_turns():
    sets = ("half-turn", "poles", "wraps", "goals", "box")
    for start in tasks.start_set("uniform", 500, seed=3) + [one for word in sets for one in tasks.start_set(word)]:
        theirs = ScipyRotation.from_quat(start.quat_wxyz, scalar_first=True).as_rotvec()
        ours = np.array(VECTOR.chart(as_rotation(columns(start.quat_wxyz))).E)
        if abs(start.quat_wxyz[0]) <= 4 * EPS:  # a half turn to rounding: both signs are right
            theirs = theirs * np.sign(theirs @ ours)
        np.testing.assert_allclose(ours, theirs, rtol=0.0, atol=TOLERANCE, err_msg=start.id)


@pytest.mark.parametrize("k", [*range(1, 17), 100, 160, 300])
def test_small_vector_keeps_all_digits(k):
    for axis in AXES:
        phi = 10.0**-k * axis
        R = as_rotation(expm(skew(phi)).T if k < 3 else (np.eye(3) + skew(phi) + 0.5 * skew(phi) @ skew(phi)).T)
        # below 1e-3 the dropped theta^3/6 is relative to theta no more than this
        dropped = 0.0 if k < 3 else 10.0 ** (-2 * k) / 2
        found = VECTOR.chart(R).E
        np.testing.assert_allclose(found, phi, rtol=0.0, atol=(TOLERANCE + dropped) * 10.0**-k)


def test_vector_is_never_longer_than_a_half_turn():
    assert max(np.linalg.norm(VECTOR.chart(R).E) for R in rotations()) <= math.pi * (1 + 2 * EPS)


def test_exact_half_turn_has_its_own_element_positive():
    for i in range(3):
        signs = -np.ones(3)
        signs[i] = 1.0
        np.testing.assert_array_equal(VECTOR.chart(as_rotation(np.diag(signs))).E, math.pi * np.eye(3)[i])


@pytest.mark.parametrize("angle", ANGLES)
def test_B_is_the_integral_of_the_exponential_and_rates_are_its_inverse(angle):
    for axis in AXES:
        at = VECTOR.chart_of(vector(angle * axis))
        expected = left_jacobian(angle * axis)
        # expm itself is good to a few EPS
        np.testing.assert_allclose(matrix_of(VECTOR.angular_velocity, at), expected, rtol=0.0, atol=TOLERANCE)
        np.testing.assert_allclose(matrix_of(VECTOR.generalized, at), expected.T, rtol=0.0, atol=TOLERANCE)
        # the inverse magnifies that by (pi/2)^2 at a half turn
        inverse = np.linalg.inv(expected)
        np.testing.assert_allclose(matrix_of(VECTOR.rates, at), inverse, rtol=0.0, atol=3 * TOLERANCE)


@pytest.mark.parametrize("angle", ANGLES)
def test_coefficients_are_their_closed_forms_of_50_digits_on_both_sides_of_each_threshold(angle):
    """Each error times the factors theta it meets, one or two, is rounding of J_l and of its derivative."""
    at = VECTOR.chart_of(vector((0.0, 0.0, angle)))
    s, a, b = coefficients(at)
    da, db = slopes(at, s, a, b)
    with mpmath.workdps(50):
        theta = mpmath.mpf(angle)
        sine, cosine = mpmath.sin(theta) / theta, (1 - mpmath.cos(theta)) / theta**2
        cubic = (1 - sine) / theta**2
        exact = sine, cosine, cubic, (sine - 2 * cosine) / theta**2, (cosine - 3 * cubic) / theta**2
        errors = [float(abs(mpmath.mpf(float(x)) - y)) for x, y in zip((s, a, b, da, db), exact, strict=True)]
    factors = (1.0, angle, angle, angle**2, angle**3)
    assert max(error * factor for error, factor in zip(errors, factors, strict=True)) <= TOLERANCE


@pytest.mark.parametrize("angle", ANGLES)
def test_accelerate_is_the_derivative_of_angular_velocity(angle):
    """Central differences of expm's J_l; h^2/6 = 2e-11 and EPS/h = 2e-11 for h = 1e-5, times numbers near 1."""
    h, draw = 1e-5, np.random.default_rng(2)
    for axis in AXES:
        phi, V, A = angle * axis, *draw.uniform(-1.0, 1.0, (2, 3))
        ahead, behind = (left_jacobian(phi + t * V + t * t * A / 2) @ (V + t * A) for t in (h, -h))
        found = VECTOR.accelerate(VECTOR.chart_of(vector(phi)), vector(V), vector(A))
        np.testing.assert_allclose(found, (ahead - behind) / (2 * h), rtol=0.0, atol=1e-9)


def test_round_trip_keeps_the_vector_up_to_the_half_turn():
    for angle in ANGLES[:-1]:
        for axis in AXES:
            phi = vector(angle * axis)
            found = VECTOR.chart(VECTOR.to_matrix(phi)).E
            sign = np.sign(np.dot(found, phi)) if angle > math.pi - 1e-14 else 1.0
            np.testing.assert_allclose(found, sign * np.array(phi), rtol=0.0, atol=TOLERANCE)


def test_margin_is_the_least_singular_value_of_B():
    for R in rotations():
        at = VECTOR.chart(R)
        least = np.linalg.svd(matrix_of(VECTOR.angular_velocity, at), compute_uv=False)[-1]
        assert VECTOR.margin(R) == pytest.approx(least, abs=TOLERANCE)
        assert VECTOR.margin(R) >= 2.0 / math.pi - 2 * EPS


def test_feedback_linearized_command_at_rest_is_kp_times_the_vector():
    law, gains = find_contender("feedback-linearized/rotation-vector").law, Gains()
    for R in rotations():
        u = np.array(law(R, vector(AT_REST), Goal(), gains))
        # J_l phi = phi: s phi + b theta^2 phi, whose two coefficients add up to 1
        assert np.abs(u + gains.kp * np.array(VECTOR.chart(R).E)).max() <= TOLERANCE * gains.kp * math.pi
