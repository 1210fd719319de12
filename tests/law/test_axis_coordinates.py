"""Coordinates along the axis of a turn (rotation vector, MRP, quaternion) against scipy and published formulas.

That B, its inverse and its derivative are those of the rotation is test_every_representation's.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import mpmath
import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS
from support.states import as_rotation, of_scipy, rotations, vector

import tasks
from bench.findings.theory.compliance_theory import matrix_B
from bench.law.contenders.registry import find_contender, representation
from bench.law.contenders.representations.rotation_vector import FLAT, NEAR, coefficients, slopes
from bench.law.inputs import Gains, Goal
from bench.law.so3 import quaternion_direction
from tasks.rotations import columns

# The bound of test_every_representation: sums of three products of up to three rounded factors.
TOLERANCE = 10 * EPS


class Axial(NamedTuple):
    """What coordinates are of a turn, by scipy, and how long at a half turn; the part along the axis comes last."""

    scipys: Callable
    share: float  # of a small angle
    at_half_turn: float


AXIAL = {
    "rotation-vector": Axial(ScipyRotation.as_rotvec, 1.0, math.pi),
    "mrp": Axial(ScipyRotation.as_mrp, 0.25, 1.0),
    "quaternion": Axial(lambda turn: turn.as_quat(canonical=True, scalar_first=True), 0.5, 1.0),
}
VECTOR, QUATERNION = representation("rotation-vector"), representation("quaternion")
AXES = np.array([*np.eye(3), (0.36, -0.48, 0.8), (-0.6, 0.64, 0.48)])
each = pytest.mark.parametrize(("one", "axial"), [(representation(word), AXIAL[word]) for word in AXIAL], ids=AXIAL)


def skew(v):
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


@each
def test_coordinates_are_scipys_everywhere_but_for_the_sign_of_half_turns(one, axial):
    sets = ("half-turn", "poles", "wraps", "goals", "box")
    for start in tasks.start_set("uniform", 500, seed=3) + [each for name in sets for each in tasks.start_set(name)]:
        theirs = axial.scipys(ScipyRotation.from_quat(start.quat_wxyz, scalar_first=True))
        ours = np.array(one.chart(as_rotation(columns(start.quat_wxyz))).E)
        if abs(start.quat_wxyz[0]) <= 4 * EPS:  # a half turn to rounding: both signs are right
            theirs = theirs * np.sign(theirs @ ours)
        np.testing.assert_allclose(ours, theirs, rtol=0.0, atol=TOLERANCE, err_msg=start.id)


@each
@pytest.mark.parametrize("k", [*range(3, 17), 100, 160, 300])
def test_small_turn_keeps_all_digits(one, axial, k):
    for axis in AXES:
        phi = 10.0**-k * axis
        found = np.array(one.chart(as_rotation((np.eye(3) + skew(phi) + 0.5 * skew(phi) @ skew(phi)).T)).E)
        # dropped: theta^3/6 of the rotation, and what the coordinates have beyond the first power of theta
        allowed = (TOLERANCE + 10.0 ** (-2 * k) / 2) * 10.0**-k
        np.testing.assert_allclose(found[-3:], axial.share * phi, rtol=0.0, atol=allowed)
        assert len(found) == 3 or found[0] == pytest.approx(1.0, abs=10.0 ** (-2 * k))


@each
def test_exact_half_turn_has_its_own_element_positive(one, axial):
    for i in range(3):
        E = one.chart(as_rotation(np.diag(2.0 * np.eye(3)[i] - 1.0))).E
        np.testing.assert_array_equal(E[-3:], axial.at_half_turn * np.eye(3)[i])
        assert len(E) == 3 or E[0] == 0.0


@each
def test_margin_is_the_least_singular_value_of_B_over_that_at_the_identity(one, axial):
    def least(R):
        return np.linalg.svd(matrix_B(one, R), compute_uv=False)[-1]

    for R in rotations():
        assert one.margin(R) == pytest.approx(least(R) / least(as_rotation(np.eye(3))), abs=TOLERANCE)


ANGLES = (
    *(10.0**-k for k in range(13)),
    *(math.sqrt(edge) * side for edge in (FLAT, NEAR) for side in (1 - 1e-9, 1.0, 1 + 1e-9)),
    *(2.0, 3.0),
    *(math.pi - 10.0**-k for k in range(1, 16)),
    math.pi,
)


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


def test_extraction_takes_every_branch_and_divides_by_no_small_number():
    seen = set()
    for R in rotations():
        q, t = quaternion_direction(R)
        seen.add(int(np.argmin(np.abs(np.abs(q) - t))))
        assert t >= 1.0 - 4 * EPS
        assert np.linalg.norm(q) == pytest.approx(2.0 * math.sqrt(t), rel=TOLERANCE)
    assert seen == {0, 1, 2, 3}


def test_feedback_linearized_command_in_the_quaternion_is_2_kp_epsilon():
    """Towards the identity: u = -2 Kp eps - Kd omega, at any rate; what is along E drops out."""
    law, gains = find_contender("feedback-linearized/quaternion").law, Gains()
    draw = np.random.default_rng(8)
    for R in rotations():
        eps, omega = np.array(QUATERNION.chart(R).E[1:]), draw.normal(scale=5.0, size=3)
        found = law(R, vector(omega), Goal(), gains)
        scale = 2.0 * gains.kp + gains.kv * np.linalg.norm(omega)
        np.testing.assert_allclose(found, -2.0 * gains.kp * eps - gains.kv * omega, rtol=0.0, atol=TOLERANCE * scale)


def test_command_in_the_quaternion_takes_the_long_way_where_goal_and_orientation_have_opposite_signs():
    """The law is so defined: an error of 20 degrees across 180° commands a rotation of 340 degrees."""
    law, gains = find_contender("feedback-linearized/quaternion").law, Gains()
    z = np.array((0.0, 0.0, 1.0))
    R, R_d = (of_scipy(ScipyRotation.from_rotvec(math.radians(angle) * z)) for angle in (170.0, 190.0))
    u = law(R, vector((0.0, 0.0, 0.0)), Goal(R_d), gains)
    np.testing.assert_allclose(u, -2.0 * gains.kp * math.sin(math.radians(10.0)) * z, rtol=0.0, atol=TOLERANCE * 200)
