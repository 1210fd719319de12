"""Laws as springs: their settling times against closed forms."""

import math

import pytest

from bench.findings.theory import closed_form, isotropic
from bench.law.display import ANGLE, LINEAR_MRP, SINE

GAINS = (100.0, 20.0, 0.02)


def test_sine_settles_as_the_closed_form_of_the_rotation_matrix():
    for angle in (0.5, 2.0, 3.1):
        expected = closed_form.settling(angle, *GAINS)
        assert isotropic.settling(SINE, angle, *GAINS) == pytest.approx(expected, abs=1e-6)


def test_straight_spring_settles_as_the_linear_system_from_every_angle():
    for angle in (0.1, 3.0):
        expected = closed_form.linear_settling(*GAINS)
        assert isotropic.settling(ANGLE, angle, *GAINS) == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize(("equation", "part"), [(LINEAR_MRP, 4.0), (isotropic.EQUATIONS["paielli-bach"], 2.0)])
def test_laws_made_linear_settle_when_their_linear_coordinate_does(equation, part):
    """tan(theta/4) and sin(theta/2) are linear: the band's edge in theta is a share of the coordinate."""
    coordinate = math.tan if part == 4.0 else math.sin
    for angle in (0.5, 2.5):
        edge = coordinate(GAINS[2] * angle / part) / coordinate(angle / part)
        expected = closed_form.linear_settling(*GAINS[:2], edge)
        assert isotropic.settling(equation, angle, *GAINS) == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize("name", isotropic.EQUATIONS)
def test_springs_push_alike_near_the_goal(name):
    assert isotropic.EQUATIONS[name].spring(1e-4) == pytest.approx(1e-4, rel=1e-8)
