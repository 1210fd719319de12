"""X-Y-Z angles against scipy and closed form, at, near and away from their poles."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS
from support.states import as_rotation, matrix, rotations, vector

import tasks
from bench.contenders.registry import representation
from tasks.rotations import columns

XYZ = representation("xyz-euler")

# The bound of test_every_representation: sums of three products of up to three rounded factors.
TOLERANCE = 10 * EPS
POLES = (math.pi / 2, -math.pi / 2)
BETAS = (
    *np.linspace(-1.4, 1.4, 9),
    *(pole + (-1 if pole > 0.0 else 1) * 10.0**-k for pole in POLES for k in (1, 4, 8, 12)),
)


def B_of(E) -> np.ndarray:
    """Columns: the axes the three angles turn about, by scipy."""
    first = ScipyRotation.from_euler("X", E[0])
    second = ScipyRotation.from_euler("XY", E[:2])
    return np.array([(1.0, 0.0, 0.0), first.apply((0.0, 1.0, 0.0)), second.apply((0.0, 0.0, 1.0))]).T


def drawn(beta, seed=6):
    """Twenty triples of angles with that middle one."""
    draw = np.random.default_rng(seed)
    return [vector((a, beta, c)) for a, c in draw.uniform(-math.pi, math.pi, (20, 2))]


@pytest.mark.parametrize("beta", BETAS)
def test_rotation_is_scipys(beta):
    for E in drawn(beta):
        expected = ScipyRotation.from_euler("XYZ", E).as_matrix()
        np.testing.assert_allclose(matrix(XYZ.to_matrix(E)), expected, rtol=0.0, atol=TOLERANCE)


@pytest.mark.parametrize("beta", BETAS)
def test_B_has_the_axes_of_the_three_turns_as_columns(beta):
    for E in drawn(beta):
        at = XYZ.chart_of(E)
        found = np.array([XYZ.angular_velocity(at, vector(unit)) for unit in np.eye(3)]).T
        np.testing.assert_allclose(found, B_of(E), rtol=0.0, atol=TOLERANCE)
        rows = np.array([XYZ.generalized(at, vector(unit)) for unit in np.eye(3)])
        np.testing.assert_allclose(rows, B_of(E), rtol=0.0, atol=TOLERANCE)


@pytest.mark.parametrize("beta", [beta for beta in BETAS if abs(math.cos(beta)) > 1e-13])
def test_rates_are_numpys_solution(beta):
    for E in drawn(beta):
        omega = np.random.default_rng(7).normal(size=3)
        found = XYZ.rates(XYZ.chart_of(E), vector(omega))
        # solving magnifies the roundings of B, 2 EPS each, by 1/margin, twice in the rate that has it already
        scale = TOLERANCE / abs(math.cos(beta)) ** 2
        np.testing.assert_allclose(found, np.linalg.solve(B_of(E), omega), rtol=0.0, atol=scale)


def test_angles_are_scipys_away_from_the_poles():
    for start in tasks.start_set("uniform", 300, seed=7) + tasks.start_set("half-turn"):
        R = as_rotation(columns(start.quat_wxyz))
        away = XYZ.margin(R)
        if away < 1e-6:  # scipy sets the third angle to zero within 1e-7 of a pole
            continue
        theirs = ScipyRotation.from_quat(start.quat_wxyz, scalar_first=True).as_euler("XYZ")
        difference = np.array(XYZ.chart(R).E) - theirs
        # the same angle on either side of a wrap; rounding of R moves the outer two by its size over the margin
        difference[[0, 2]] = (difference[[0, 2]] + math.pi) % (2.0 * math.pi) - math.pi
        assert np.abs(difference).max() <= TOLERANCE / away + 4 * EPS, start.id


@pytest.mark.parametrize("k", range(1, 13))
def test_angles_near_the_poles_are_those_the_rotation_was_made_of(k):
    for pole in POLES:
        for E in drawn(pole + (-1 if pole > 0.0 else 1) * 10.0**-k):
            difference = np.array(XYZ.chart(XYZ.to_matrix(E)).E) - E
            difference[[0, 2]] = (difference[[0, 2]] + math.pi) % (2.0 * math.pi) - math.pi
            assert np.abs(difference[[0, 2]]).max() <= TOLERANCE * 10.0**k
            assert abs(difference[1]) <= TOLERANCE


def test_angles_of_the_axes_are_turns_about_x_then_y_then_z():
    for i, axis in enumerate(np.eye(3)):
        turned = as_rotation(ScipyRotation.from_rotvec(0.3 * axis).as_matrix().T)
        np.testing.assert_allclose(XYZ.chart(turned).E, 0.3 * np.eye(3)[i], rtol=0.0, atol=2 * EPS)


@pytest.mark.parametrize("sign", [1, -1])
def test_pole_is_90_degrees_about_y_and_goes_into_gamma(sign):
    for turn in (0.5, 2.5, -1.4, math.pi / 2):
        s, c = math.sin(turn), math.cos(turn)
        R = as_rotation([(0.0, s, -sign * c), (0.0, c, sign * s), (sign, 0.0, 0.0)])
        assert XYZ.margin(R) == 0.0
        np.testing.assert_allclose(XYZ.chart(R).E, (0.0, sign * math.pi / 2, turn), rtol=0.0, atol=4 * EPS)
        with np.errstate(all="ignore"):
            assert not np.isfinite(XYZ.rates(XYZ.chart(R), vector((1.0, 1.0, 1.0)))).all()


@pytest.mark.parametrize(("pole", "kept"), [(math.pi / 2, 1), (-math.pi / 2, -1)])
def test_pole_determines_the_sum_at_plus_and_the_difference_at_minus_90_degrees(pole, kept):
    shift = 0.7
    for E in drawn(pole):
        one = matrix(XYZ.to_matrix(E))
        same = matrix(XYZ.to_matrix(vector((E[0] + shift, pole, E[2] - kept * shift))))
        other = matrix(XYZ.to_matrix(vector((E[0] + shift, pole, E[2] + kept * shift))))
        np.testing.assert_allclose(same, one, rtol=0.0, atol=TOLERANCE)
        assert np.abs(other - one).max() >= math.sin(shift)


def test_identity_is_regular_and_farthest_from_the_poles():
    assert XYZ.margin(as_rotation(np.eye(3))) == 1.0
    assert max(XYZ.margin(R) for R in rotations()) <= 1.0 + 2 * EPS


def test_margin_is_the_cosine_of_beta():
    for beta in np.linspace(-1.4, 1.4, 41):
        found = XYZ.margin(XYZ.to_matrix(vector((0.7, beta, -2.0))))
        assert found == pytest.approx(math.cos(beta), abs=2 * EPS)


@pytest.mark.parametrize("index", [0, 2])
def test_outer_angles_jump_by_a_full_turn_at_the_wraps(index):
    below, above = np.full((2, 3), 0.4)
    below[index], above[index] = math.pi - 1e-9, -math.pi + 1e-9
    ends = [XYZ.to_matrix(vector(angles)) for angles in (below, above)]
    assert np.abs(matrix(ends[0]) - matrix(ends[1])).max() < 3e-9
    jump = XYZ.chart(ends[0]).E[index] - XYZ.chart(ends[1]).E[index]
    assert jump == pytest.approx(2.0 * math.pi, abs=1e-8)
