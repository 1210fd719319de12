"""Closed forms of settling times, laws as springs and what complies: the paper's, scipy's, their own."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm
from scipy.special import lambertw

from bench.findings.theory import closed_form, compliance_theory, isotropic
from bench.law.control.setpoint import TOUCH
from bench.law.display import ANGLE, LINEAR_MRP, SINE
from bench.law.inputs import PAPERS_GAINS, Gains

PAPER = 100.0, 20.0
TOLERANCE = 0.02


@pytest.mark.parametrize("gains", [PAPER, (100.0, 10.0), (100.0, 40.0)])
def test_linear_response_is_the_matrix_exponential(gains):
    system = np.array([[0.0, 1.0], [-gains[0], -gains[1]]])
    times = np.array((0.03, 0.2, 0.7))
    expected = [expm(system * t)[0, 0] for t in times]
    np.testing.assert_allclose(closed_form.linear(times, *gains), expected, atol=1e-12)


@pytest.mark.parametrize("kp", [25.0, 100.0, 400.0])
def test_linear_settling_solves_the_critically_damped_closed_form(kp):
    # (1 + x) exp(-x) = c has the solution x = -1 - W_-1(-c/e)
    x = -1.0 - lambertw(-TOLERANCE / math.e, -1).real
    assert closed_form.linear_settling(kp, 2 * math.sqrt(kp)) == pytest.approx(x / math.sqrt(kp), rel=1e-9)


def test_linear_settling_is_the_last_crossing_when_underdamped():
    # x = exp(-5 t) (cos w t + 5/w sin w t), w = sqrt(75): the envelope allows at most ln(50 * 2/sqrt 3)/5 s
    time = closed_form.linear_settling(100.0, 10.0, TOLERANCE)
    w = math.sqrt(75.0)
    after = time + np.linspace(1e-6, 1.0, 1000)
    response = np.exp(-5 * after) * (np.cos(w * after) + 5 / w * np.sin(w * after))
    assert np.all(np.abs(response) < TOLERANCE)
    assert time < math.log(100 / math.sqrt(3)) / 5


def settle(short, kp, kv, tolerance):
    """Integrate the rotation-matrix law from `short` of a half turn, by what is left: the angle rounds."""

    def edge(_, state):
        return abs(math.pi - state[0]) - tolerance * (math.pi - short)

    given = (lambda _, x: (x[1], kp * math.sin(x[0]) - kv * x[1])), (0.0, 9.0), (short, 0.0)
    return solve_ivp(*given, "DOP853", events=edge, rtol=1e-11, atol=1e-15).t_events[0][-1]


def test_settling_grows_by_the_slope_each_decade_near_the_half_turn():
    times = [settle(10.0**-k, *PAPER, TOLERANCE) for k in (6, 7)]
    assert times[1] - times[0] == pytest.approx(closed_form.decade_slope(*PAPER), rel=1e-6)


def push(kp, kv) -> float:
    """Integrate where a unit moment takes a spring with a damper in 0.3 s."""

    def rates(_, state):
        return state[1], 1.0 / TOUCH.m_o - kv * state[1] - kp * state[0]

    return solve_ivp(rates, (0.0, 0.3), (0.0, 0.0), rtol=1e-11, atol=1e-14).y[0, -1]


SPRUNG = [PAPERS_GAINS, Gains(100.0, 10.0), Gains(100.0, 40.0)]
YIELDS = [
    *((compliance_theory.sprung(0.3, gains), gains) for gains in SPRUNG),
    (compliance_theory.free(0.3), (0.0, TOUCH.kc)),
]


@pytest.mark.parametrize(("yields", "gains"), YIELDS, ids=str)
def test_what_a_moment_turns_is_an_integrated_oscillator_or_damper(yields, gains):
    assert yields == pytest.approx(push(*gains), rel=1e-8)


GAINS = (100.0, 20.0, 0.02)


@pytest.mark.parametrize("angle", [0.1, 0.5, 2.0, 3.1])
def test_sine_settles_as_it_is_integrated_and_a_straight_spring_as_the_linear_system(angle):
    for equation, expected in (
        (SINE, settle(math.pi - angle, *GAINS)),
        (ANGLE, closed_form.linear_settling(*GAINS)),
    ):
        assert isotropic.settling(equation, angle, *GAINS) == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize(("equation", "part"), [(LINEAR_MRP, 4.0), (isotropic.EQUATIONS["paielli-bach"], 2.0)])
def test_laws_made_linear_settle_when_their_linear_coordinate_does(equation, part):
    """tan(theta/4) and sin(theta/2) are linear: the band's edge in theta is a share of the coordinate."""
    coordinate = math.tan if part == 4.0 else math.sin
    for angle in (0.5, 2.5):
        edge = coordinate(GAINS[2] * angle / part) / coordinate(angle / part)
        expected = closed_form.linear_settling(*GAINS[:2], edge)
        assert isotropic.settling(equation, angle, *GAINS) == pytest.approx(expected, abs=1e-6)
