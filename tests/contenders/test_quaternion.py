"""The unit quaternion against scipy, in each branch of its extraction and on the seams between them."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS
from support.states import as_rotation, rotations, vector

import tasks
from bench.contenders.registry import find_contender, representation
from bench.law.contender import Gains, Goal
from bench.law.so3 import quaternion_direction
from tasks.rotations import columns

QUATERNION = representation("quaternion")
# The bound of test_every_representation: sums of three products of up to three rounded factors.
TOLERANCE = 10 * EPS


def matrix_of(kernel, at, count):
    return np.array([kernel(at, vector(unit)) for unit in np.eye(count)]).T


def of(scipys: ScipyRotation):
    return as_rotation(scipys.as_matrix().T)


def test_quaternion_is_scipys_everywhere_but_for_the_sign_of_half_turns():
    sets = ("half-turn", "poles", "wraps", "goals", "box")
    for start in tasks.start_set("uniform", 500, seed=3) + [one for word in sets for one in tasks.start_set(word)]:
        theirs = ScipyRotation.from_quat(start.quat_wxyz, scalar_first=True).as_quat(canonical=True, scalar_first=True)
        ours = np.array(QUATERNION.chart(as_rotation(columns(start.quat_wxyz))).E)
        if abs(start.quat_wxyz[0]) <= 4 * EPS:  # a half turn to rounding: both signs are right
            theirs = theirs * np.sign(theirs @ ours)
        np.testing.assert_allclose(ours, theirs, rtol=0.0, atol=TOLERANCE, err_msg=start.id)


def test_extraction_takes_every_branch_and_divides_by_no_small_number():
    seen = set()
    for R in rotations():
        q, t = quaternion_direction(R)
        seen.add(int(np.argmin(np.abs(np.abs(q) - t))))
        assert t >= 1.0 - 4 * EPS
        assert np.linalg.norm(q) == pytest.approx(2.0 * math.sqrt(t), rel=TOLERANCE)
    assert seen == {0, 1, 2, 3}


def test_extraction_is_continuous_over_the_seams_of_its_branches():
    """Where two branches meet both are exact: n_x = o_y, n_x = -o_y, a_z = 0."""
    draw = np.random.default_rng(4)
    for q in draw.normal(size=(300, 4)):
        w, x, y, z = q / np.linalg.norm(q)
        xy, wz = math.hypot(x, y), math.hypot(w, z)
        seams = (
            (w, xy, xy, z),  # n_x = o_y
            (wz, x, y, wz),  # n_x = -o_y
            (w * xy, x * wz, y * wz, z * xy),  # a_z = 0
        )
        for seam in seams:
            on_seam = np.array(seam) / np.linalg.norm(seam)
            for nudge in draw.normal(scale=1e-15, size=(4, 4)):
                scipys = ScipyRotation.from_quat(on_seam + nudge, scalar_first=True)
                found = np.array(QUATERNION.chart(of(scipys)).E)
                expected = scipys.as_quat(scalar_first=True)
                np.testing.assert_allclose(found, expected * np.sign(expected @ found), rtol=0.0, atol=TOLERANCE)


def test_quaternion_is_of_length_1_with_w_not_negative():
    for R in rotations():
        E = QUATERNION.chart(R).E
        assert np.linalg.norm(E) == pytest.approx(1.0, abs=TOLERANCE)
        assert E[0] >= 0.0


def test_exact_half_turn_has_w_zero_and_its_own_element_positive():
    for i in range(3):
        signs = -np.ones(3)
        signs[i] = 1.0
        np.testing.assert_array_equal(QUATERNION.chart(as_rotation(np.diag(signs))).E, np.eye(4)[i + 1])


@pytest.mark.parametrize("k", [8, 16, 100, 300])
def test_small_quaternion_is_half_the_angle(k):
    phi = 10.0**-k * np.array((0.36, -0.48, 0.8))
    skew = np.array([[0.0, -phi[2], phi[1]], [phi[2], 0.0, -phi[0]], [-phi[1], phi[0], 0.0]])
    found = QUATERNION.chart(as_rotation((np.eye(3) + skew).T)).E
    assert found[0] == 1.0
    np.testing.assert_allclose(found[1:], 0.5 * phi, rtol=0.0, atol=TOLERANCE * 10.0**-k)


# Central differences with h = 1e-5: h^2/24 = 4e-12 of a third derivative below 1, EPS/h = 2e-11.
STEP = 1e-5


def test_rates_are_differences_of_scipys_quaternion():
    draw = np.random.default_rng(5)
    for turned in ScipyRotation.random(100, rng=6):
        omega = draw.normal(size=3)
        omega = omega / np.linalg.norm(omega)
        E = np.array(QUATERNION.chart(of(turned)).E)
        ahead, behind = (
            (ScipyRotation.from_rotvec(h * omega) * turned).as_quat(scalar_first=True) for h in (STEP, -STEP)
        )
        expected = (ahead * np.sign(ahead @ E) - behind * np.sign(behind @ E)) / (2 * STEP)
        found = QUATERNION.rates(QUATERNION.chart(of(turned)), vector(omega))
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-10)


def test_B_is_twice_a_matrix_with_orthonormal_rows_perpendicular_to_E():
    for R in rotations():
        at = QUATERNION.chart(R)
        B = matrix_of(QUATERNION.angular_velocity, at, 4)
        np.testing.assert_allclose(B @ B.T, 4.0 * np.eye(3), rtol=0.0, atol=4 * TOLERANCE)
        np.testing.assert_allclose(B @ at.E, np.zeros(3), rtol=0.0, atol=TOLERANCE)
        np.testing.assert_allclose(matrix_of(QUATERNION.rates, at, 3), B.T / 4.0, rtol=0.0, atol=TOLERANCE)
        np.testing.assert_array_equal(matrix_of(QUATERNION.generalized, at, 3), B.T)
        assert QUATERNION.margin(R) == 1.0


def test_acceleration_has_no_part_of_the_rates():
    """Bdot Edot = 2 vec(Edot Edot*) = 0: B(Edot) Edot, B being linear in E."""
    draw = np.random.default_rng(6)
    for R in rotations():
        at = QUATERNION.chart(R)
        Edot = QUATERNION.rates(at, vector(draw.normal(scale=5.0, size=3)))
        Bdot = matrix_of(QUATERNION.angular_velocity, QUATERNION.chart_of(Edot), 4)
        np.testing.assert_allclose(Bdot @ Edot, np.zeros(3), rtol=0.0, atol=TOLERANCE * np.dot(Edot, Edot))
        Eddot = vector(draw.normal(size=4))
        expected = matrix_of(QUATERNION.angular_velocity, at, 4) @ Eddot
        np.testing.assert_allclose(QUATERNION.accelerate(at, Edot, Eddot), expected, rtol=0.0, atol=2 * TOLERANCE)


def test_feedback_linearized_command_is_2_kp_epsilon():
    """Towards the identity: u = -2 Kp eps - Kd omega, at any rate; what is along E drops out."""
    law, gains = find_contender("feedback-linearized/quaternion").law, Gains()
    draw = np.random.default_rng(8)
    for R in rotations():
        eps, omega = np.array(QUATERNION.chart(R).E[1:]), draw.normal(scale=5.0, size=3)
        found = law(R, vector(omega), Goal(), gains)
        scale = 2.0 * gains.kp + gains.kv * np.linalg.norm(omega)
        np.testing.assert_allclose(found, -2.0 * gains.kp * eps - gains.kv * omega, rtol=0.0, atol=TOLERANCE * scale)


def test_command_takes_the_long_way_where_goal_and_orientation_have_opposite_signs():
    """By definition of the law: 20 degrees of error over the half turn command the turn of 340 degrees."""
    law, gains = find_contender("feedback-linearized/quaternion").law, Gains()
    z = np.array((0.0, 0.0, 1.0))
    R, R_d = (of(ScipyRotation.from_rotvec(math.radians(angle) * z)) for angle in (170.0, 190.0))
    u = law(R, vector((0.0, 0.0, 0.0)), Goal(R_d), gains)
    np.testing.assert_allclose(u, -2.0 * gains.kp * math.sin(math.radians(10.0)) * z, rtol=0.0, atol=TOLERANCE * 200)
