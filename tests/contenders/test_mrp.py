"""Modified Rodrigues parameters against scipy and the published formulas, at every angle up to the half turn."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS
from support.states import as_rotation, rotations, vector

import tasks
from bench.contenders.registry import find_contender, representation
from bench.law.contender import Gains, Goal
from tasks.rotations import columns

MRP = representation("mrp")
# The bound of test_every_representation: sums of three products of up to three rounded factors.
TOLERANCE = 10 * EPS


def skew(v):
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def matrix_of(kernel, at):
    return np.array([kernel(at, vector(unit)) for unit in np.eye(3)]).T


def inverse_B(sigma):
    """Schaub & Junkins 2003, their B/4, for omega in the base frame: the sign of the cross product is turned."""
    square = sigma @ sigma
    return ((1.0 - square) * np.eye(3) - 2.0 * skew(sigma) + 2.0 * np.outer(sigma, sigma)) / 4.0


def test_parameters_are_scipys_everywhere_but_for_the_sign_of_half_turns():
    sets = ("half-turn", "poles", "wraps", "goals", "box")
    for start in tasks.start_set("uniform", 500, seed=3) + [one for word in sets for one in tasks.start_set(word)]:
        theirs = ScipyRotation.from_quat(start.quat_wxyz, scalar_first=True).as_mrp()
        ours = np.array(MRP.chart(as_rotation(columns(start.quat_wxyz))).E)
        if abs(start.quat_wxyz[0]) <= 4 * EPS:  # a half turn to rounding: sigma and its shadow are both right
            theirs = theirs * np.sign(theirs @ ours)
        np.testing.assert_allclose(ours, theirs, rtol=0.0, atol=TOLERANCE, err_msg=start.id)


@pytest.mark.parametrize("k", [8, 12, 16, 100, 300])
def test_small_parameters_are_a_quarter_of_the_angle(k):
    axis = np.array((0.36, -0.48, 0.8))
    R = as_rotation((np.eye(3) + skew(10.0**-k * axis)).T)
    # dropped: theta^2 of 1e-16 at most
    np.testing.assert_allclose(MRP.chart(R).E, 0.25 * 10.0**-k * axis, rtol=0.0, atol=TOLERANCE * 10.0**-k)


def test_parameters_are_never_longer_than_1():
    assert max(np.linalg.norm(MRP.chart(R).E) for R in rotations()) <= 1.0 + 2 * EPS


def test_exact_half_turn_has_its_own_element_positive():
    for i in range(3):
        signs = -np.ones(3)
        signs[i] = 1.0
        np.testing.assert_array_equal(MRP.chart(as_rotation(np.diag(signs))).E, np.eye(3)[i])


def test_parameters_jump_to_their_shadow_at_the_half_turn():
    axis = np.array((0.36, -0.48, 0.8))
    before, after = (
        np.array(MRP.chart(as_rotation(ScipyRotation.from_rotvec((math.pi + d) * axis).as_matrix().T)).E)
        for d in (-1e-9, 1e-9)
    )
    np.testing.assert_allclose(before, axis, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(after, -axis, rtol=0.0, atol=1e-9)


def test_B_is_a_rotation_by_half_the_angle_times_its_size():
    for R in rotations():
        at = MRP.chart(R)
        sigma = np.array(at.E)
        size = 4.0 / (1.0 + sigma @ sigma)
        B = matrix_of(MRP.angular_velocity, at)
        half = ScipyRotation.from_quat((1.0, *sigma), scalar_first=True)  # tan(theta/4) k is what (1, sigma) turns by
        expected = size * half.as_matrix()
        np.testing.assert_allclose(B, expected, rtol=0.0, atol=TOLERANCE * size)
        assert np.linalg.cond(B) == pytest.approx(1.0, abs=TOLERANCE)


def test_rates_and_B_are_the_published_matrix_and_its_inverse():
    for R in rotations():
        at = MRP.chart(R)
        sigma = np.array(at.E)
        inverse, square = inverse_B(sigma), sigma @ sigma
        np.testing.assert_allclose(matrix_of(MRP.rates, at), inverse, rtol=0.0, atol=TOLERANCE)
        B = 16.0 / (1.0 + square) ** 2 * inverse.T
        np.testing.assert_allclose(matrix_of(MRP.angular_velocity, at), B, rtol=0.0, atol=4 * TOLERANCE)
        np.testing.assert_allclose(matrix_of(MRP.generalized, at), B.T, rtol=0.0, atol=4 * TOLERANCE)


# Of central differences with h = 1e-4: h^2/6 times a third derivative near 1 leaves 2e-9, EPS/h 2e-12, and of second
# differences h^2/12 = 1e-9 and 4 EPS/h^2 = 1e-7.
STEP = 1e-4


def test_rates_and_accelerate_are_differences_of_scipys_parameters():
    """The sign of the cross product is what a body-frame omega has the other way round."""
    draw = np.random.default_rng(5)
    for turned in ScipyRotation.random(100, rng=6):
        if turned.magnitude() > 3.0:
            continue  # near the shadow set
        omega = draw.normal(size=3)
        omega = omega / np.linalg.norm(omega)
        behind, here, ahead = ((ScipyRotation.from_rotvec(h * omega) * turned).as_mrp() for h in (-STEP, 0.0, STEP))
        at = MRP.chart(as_rotation(turned.as_matrix().T))
        Edot, Eddot = (ahead - behind) / (2 * STEP), (ahead - 2 * here + behind) / STEP**2
        np.testing.assert_allclose(MRP.rates(at, vector(omega)), Edot, rtol=0.0, atol=1e-8)
        # omega is constant; B is at most 4
        np.testing.assert_allclose(MRP.accelerate(at, vector(Edot), vector(Eddot)), np.zeros(3), atol=4e-6)


def test_margin_is_a_quarter_of_the_size_of_B():
    for R in rotations():
        size = np.linalg.norm(matrix_of(MRP.angular_velocity, MRP.chart(R)), 2)
        assert MRP.margin(R) == pytest.approx(size / 4.0, abs=TOLERANCE)
        assert MRP.margin(R) >= 0.5 - EPS


def test_feedback_linearized_command_is_the_published_law():
    """u = -Kd omega - (4 Kp/(1 + sigma^2) - omega^2/2) sigma - omega (omega . sigma) towards the identity."""
    law, gains = find_contender("feedback-linearized/mrp").law, Gains()
    draw = np.random.default_rng(8)
    for R in rotations():
        sigma, omega = np.array(MRP.chart(R).E), draw.normal(scale=5.0, size=3)
        stiffness = 4.0 * gains.kp / (1.0 + sigma @ sigma) - omega @ omega / 2.0
        expected = -gains.kv * omega - stiffness * sigma - omega * (omega @ sigma)
        scale = 4.0 * gains.kp + gains.kv * np.linalg.norm(omega) + omega @ omega
        found = law(R, vector(omega), Goal(), gains)
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=TOLERANCE * scale)
