"""The page of the law that brakes late: its figures and tables say what its scalar equation says."""

import math

import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from scipy.integrate import quad

from bench.findings.theory.isotropic import EQUATIONS
from bench.law.display import ANGLE
from bench.law.inputs import Gains
from report.figures.comparison import a_new_law as new_law
from report.figures.comparison.cells import LEVEL

KP, KV = Gains()
LATE = EQUATIONS["late-braking"]


def test_greatest_pull_is_the_closed_forms():
    assert new_law.greatest_pull(LATE) == pytest.approx(4.0 / 3.0 * math.sqrt(2.0 / 3.0), rel=1e-6)


def test_gains_at_equal_peak_pull_alike_and_are_critically_damped():
    for equation in new_law.DRAWN.values():
        kp, kv = new_law.peak_gains(equation)
        assert kp * new_law.greatest_pull(equation) == pytest.approx(LEVEL, rel=1e-12)
        assert kv * kv == pytest.approx(4.0 * kp, rel=1e-12)


def test_response_of_a_straight_spring_is_the_linear_one_with_its_effort():
    """x = (1 + 10 t) exp(-10 t), u = -x'' = (1 - 10 t) 100 exp(-10 t)."""
    times, angle, command, effort = new_law.response(ANGLE, 1.0, KP, KV)
    for t, x, u in zip(times, angle, command, strict=True):
        assert x == pytest.approx((1.0 + 10.0 * t) * math.exp(-10.0 * t), abs=1e-8)
        assert u == pytest.approx(100.0 * (1.0 - 10.0 * t) * math.exp(-10.0 * t), abs=1e-6)
    spent = quad(lambda t: (100.0 * (1.0 - 10.0 * t) * math.exp(-10.0 * t)) ** 2, 0.0, new_law.SHOWN_S)[0]
    assert effort[-1] == pytest.approx(spent, rel=1e-7)
