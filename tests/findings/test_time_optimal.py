"""The least settling time: known cases, closed forms, invariances, a proved bound, and a collocation."""

import functools
import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support import collocation

from bench.findings.theory.bang_bang import least_time
from bench.findings.theory.extremals import follow
from bench.findings.theory.time_optimal import (
    certain_least_time,
    find_arrivals,
    find_extremals,
    least_settling_time,
    least_time_about_axis,
    least_time_to_rest,
    place_body,
)

ACCELERATION = 10.0
"""rad/s^2"""

AXIS = np.array([0.0, 0.0, 1.0])
TURN = math.radians(120.0)

# A body that turns by 120 deg and spins across, about the axis and back, and in no special direction.
SPINS = [(10.0, 0.0, 0.0), (0.0, 0.0, 5.0), (3.0, -2.0, 1.0)]


def turn_about(axis, angle):
    """Return the quaternion w, x, y, z of a turn."""
    vector = math.sin(0.5 * angle) * np.asarray(axis) / np.linalg.norm(axis)
    return np.array([math.cos(0.5 * angle), *vector])


@functools.cache
def settle(spin, guesses=60):
    """Return the least settling time from TURN about AXIS with a spin."""
    return least_settling_time(turn_about(AXIS, TURN), spin, ACCELERATION, guesses)


@functools.cache
def come_to_rest(spin):
    """Return the least time to rest from TURN about AXIS with a spin."""
    return least_time_to_rest(turn_about(AXIS, TURN), spin, ACCELERATION)


@pytest.mark.parametrize(
    ("angle_deg", "spin", "expected"),
    # computed elsewhere, by collocation and by shooting from it
    [
        (120.0, (0.0, 0.0, 0.0), 0.915291),
        (179.0, (0.0, 0.0, 0.0), 1.117880),
        (120.0, (10.0, 0.0, 0.0), 1.407360),
        (120.0, (0.0, 0.0, -10.0), 1.3133),
    ],
)
def test_time_to_rest_is_the_known_one(angle_deg, spin, expected):
    quat = turn_about(AXIS, math.radians(angle_deg))
    assert least_time_to_rest(quat, spin, ACCELERATION) == pytest.approx(expected, rel=1e-4)


def test_shooting_finds_the_closed_form_from_rest():
    # shooting alone, to rest and to the band
    body = place_body(turn_about((1.0, 2.0, 3.0), 2.0), (0.0, 0.0, 0.0))
    extremals = find_extremals(body)
    arrivals = find_arrivals(body, extremals)
    assert extremals.times[0] == pytest.approx(2.0 * math.sqrt(2.0), rel=1e-4)
    assert arrivals.times[0] == pytest.approx(least_time(2.0, 1.0), rel=1e-4)


def test_shooting_finds_the_closed_form_of_a_spin_about_the_axis():
    body = place_body(turn_about(AXIS, 2.0), (0.0, 0.0, 0.8))
    closed = least_time_about_axis(2.0, -0.8, 1.0, 0.0)
    assert find_extremals(body).times[0] == pytest.approx(closed, rel=1e-4)
    closed_to_band = least_time_about_axis(2.0, -0.8, 1.0)
    arrivals = find_arrivals(body, find_extremals(body))
    assert arrivals.times[0] == pytest.approx(closed_to_band, rel=1e-4)


def search_times(distance, speed, band):
    """Return the times of motions that push for a while, then brake, and enter a band ahead, found on a fine grid."""
    pushing = np.linspace(0.0, 16.0, 400_001)
    top = speed + pushing
    braking = top - 2.0 * math.sqrt(band)
    travelled = speed * pushing + 0.5 * pushing**2 + top * braking - 0.5 * braking**2
    lacking = distance - band - travelled
    crosses = (lacking[:-1] > 0.0) & (lacking[1:] <= 0.0) & (braking[:-1] >= 0.0)
    return (pushing + braking)[1:][crosses]


@pytest.mark.parametrize("rate", [-6.0, -2.5, -0.4, 0.0, 0.3, 1.9, 2.2, 7.0])
@pytest.mark.parametrize("tolerance", [0.0, 0.02])
def test_time_about_an_axis_is_that_of_a_plain_search(rate, tolerance):
    angle = 1.7
    found = []
    for place in angle + 2.0 * math.pi * np.arange(-6, 7):
        for sign in (-1.0, 1.0):
            found += search_times(sign * place, sign * rate, tolerance * angle).tolist()
    closed = least_time_about_axis(angle, rate, 1.0, tolerance)
    assert closed == pytest.approx(min(found), rel=1e-4)


@pytest.mark.parametrize("angle", [1e-3, 0.4, 2.0, math.pi])
def test_time_about_an_axis_from_rest_is_that_of_the_band(angle):
    expected = least_time(angle, ACCELERATION)
    assert least_time_about_axis(angle, 0.0, ACCELERATION) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("angle", [1e-3, 0.4, 2.0, math.pi])
def test_proved_bound_is_that_of_the_closed_form_from_rest(angle):
    certain = certain_least_time(angle, 0.0, ACCELERATION)
    expected = least_time(angle, ACCELERATION)
    assert certain <= expected
    assert certain == pytest.approx(expected, rel=2e-4)
    at_rest = certain_least_time(angle, 0.0, ACCELERATION, 0.0)
    assert at_rest == pytest.approx(2.0 * math.sqrt(angle / ACCELERATION), rel=1e-12)


@pytest.mark.parametrize("spin", SPINS)
def test_time_lies_above_the_proved_bound(spin):
    speed = float(np.linalg.norm(spin))
    assert settle(spin) >= certain_least_time(TURN, speed, ACCELERATION)
    assert come_to_rest(spin) >= certain_least_time(TURN, speed, ACCELERATION, 0.0)


@pytest.mark.parametrize("spin", SPINS)
def test_settling_takes_less_than_rest_by_the_time_in_the_band(spin):
    band = 0.02 * TURN
    saved = come_to_rest(spin) - settle(spin)
    # Straight braking from the band's edge to the goal, and to the far edge.
    assert math.sqrt(2.0 * band / ACCELERATION) <= saved * (1.0 + 1e-4)
    assert saved <= 2.0 * math.sqrt(band / ACCELERATION) * (1.0 + 1e-4)


@pytest.mark.parametrize("spin", SPINS[::2])
def test_time_does_not_depend_on_the_frame(spin):
    rotation = Rotation.from_rotvec((0.3, -1.1, 2.0))
    turned_axis, turned_spin = rotation.apply([AXIS, spin])
    quat = turn_about(turned_axis, TURN)
    other = least_settling_time(quat, turned_spin, ACCELERATION)
    assert other == pytest.approx(settle(spin), rel=2e-4)
    other_sign = least_settling_time(-quat, turned_spin, ACCELERATION)
    assert other_sign == pytest.approx(settle(spin), rel=2e-4)


def test_time_scales_with_the_bound():
    # Four times the acceleration and twice the speed: the same motion in half the time.
    spin = SPINS[2]
    faster = least_settling_time(turn_about(AXIS, TURN), 2.0 * np.array(spin), 4.0 * ACCELERATION)
    assert faster == pytest.approx(0.5 * settle(spin), rel=1e-6)


def test_shooting_ends_at_the_edge_of_the_band_and_can_stay_there():
    body = place_body(turn_about(AXIS, TURN), (1.0, 0.5, 0.2))
    arrivals = find_arrivals(body, find_extremals(body))
    count = len(arrivals.times)
    assert count >= 1
    end = follow(body.take(np.zeros(count, dtype=int)), arrivals.unknown, 400)
    [band] = body.band
    angles = 2.0 * np.arcsin(np.linalg.norm(end.quat[1:], axis=0))
    assert angles == pytest.approx(band, rel=5e-3)
    speeds = np.linalg.norm(end.omega, axis=0)
    assert (speeds <= 2.005 * math.sqrt(band)).all()
    assert (speeds >= math.sqrt(band)).all()


def test_finer_steps_give_the_same_time():
    body = place_body(turn_about((1.0, 2.0, 3.0), 2.2), (3.0, -4.0, 1.0))
    coarse = find_arrivals(body, find_extremals(body))
    fine = find_arrivals(body, find_extremals(body, steps=240), steps=240)
    assert coarse.times[0] == pytest.approx(fine.times[0], rel=2e-4)


@functools.cache
def make_program():
    """Return the collocation's program, made once."""
    return collocation.make_program()


@pytest.mark.slow
@pytest.mark.parametrize("spin", SPINS)
def test_collocation_settles_as_fast(spin):
    unit_s = 1.0 / math.sqrt(ACCELERATION)
    start = np.concatenate([turn_about(AXIS, TURN), unit_s * np.array(spin)])
    ours = settle(spin) / unit_s
    rng = np.random.default_rng(7)
    times = [
        collocation.solve(make_program(), start, 0.02 * TURN, 1.5 * ours, rng) for _ in range(6)
    ]
    # It is shorter by nothing but what is seen as flat, and longer by its division into 40 parts.
    assert min(times) == pytest.approx(ours, rel=1.5e-3)
