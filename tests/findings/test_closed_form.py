"""What theory says of settling times, against the paper's closed forms and against itself."""

import math

import numpy as np
import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from bench.findings.theory import closed_form

PAPER = 100.0, 20.0
TOLERANCE = 0.02


def test_linear_response_is_the_papers_critically_damped_one():
    times = np.linspace(0.0, 1.0, 11)
    np.testing.assert_allclose(closed_form.linear(times, *PAPER), (1 + 10 * times) * np.exp(-10 * times), atol=1e-13)


def test_linear_settling_is_the_root_of_the_closed_form():
    time = closed_form.linear_settling(*PAPER, TOLERANCE)
    assert (1 + 10 * time) * math.exp(-10 * time) == pytest.approx(TOLERANCE, rel=1e-9)


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


def test_settling_grows_by_the_slope_each_decade_near_the_half_turn():
    times = [closed_form.settling(0.0, *PAPER, TOLERANCE, short=10.0**-k) for k in (6, 7)]
    assert times[1] - times[0] == pytest.approx(closed_form.decade_slope(*PAPER), rel=1e-6)


@pytest.mark.parametrize("short", [1e-12, 3.3e-7, 0.02, 0.7, 1.9, 3.0, 3.14])
def test_settling_curve_is_within_a_thousandth_of_a_tick(short):
    curve = closed_form.settling_curve(*PAPER, TOLERANCE)
    assert float(curve(np.array(short))) == pytest.approx(
        closed_form.settling(0.0, *PAPER, TOLERANCE, short=short), abs=1e-6
    )
