"""What theory says of settling times, against the paper's closed forms and against itself."""

import math

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.special import lambertw

from bench.findings.theory import closed_form

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


def test_settling_of_a_small_angle_is_the_linear_one():
    small = closed_form.settling(1e-3, *PAPER, TOLERANCE)
    assert small == pytest.approx(closed_form.linear_settling(*PAPER, TOLERANCE), abs=1e-6)


def test_settling_is_infinite_at_the_half_turn():
    assert closed_form.settling(math.pi, *PAPER, TOLERANCE) == math.inf


def test_slope_of_a_decade_is_the_saddles_unstable_root():
    root = np.linalg.eigvals(np.array([[0.0, 1.0], [100.0, -20.0]])).max()
    assert closed_form.decade_slope(*PAPER) == pytest.approx(math.log(10) / root, rel=1e-12)


def test_settling_grows_by_the_slope_each_decade_near_the_half_turn():
    times = [closed_form.settling(0.0, *PAPER, TOLERANCE, short=10.0**-k) for k in (6, 7)]
    assert times[1] - times[0] == pytest.approx(closed_form.decade_slope(*PAPER), rel=1e-6)


@pytest.mark.parametrize("short", [1e-12, 3.3e-7, 0.02, 0.7, 1.9, 3.0, 3.14])
def test_settling_curve_is_within_a_thousandth_of_a_tick(short):
    curve = closed_form.settling_curve(*PAPER, TOLERANCE)
    assert float(curve(np.array(short))) == pytest.approx(
        closed_form.settling(0.0, *PAPER, TOLERANCE, short=short), abs=1e-6
    )
