"""Rows of laws with a state: bit for bit the plain loop's, scipy's motion, and what a disturbance leaves in theory."""

import functools
import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.compensated import left, motion

import tasks
from bench.engines.simulate_bodies import run_compensated
from bench.experiments.compensators import BAND_RAD, DISTURBANCES, law_of
from bench.experiments.experiment import Settings, Unit, rows_of
from bench.law.contenders.registry import contenders
from bench.law.inputs import Gains
from tasks.base import Start

NAMES = ("", *contenders("compensators"))
PUSHED = (3.0, -4.0, 2.0)


def run(one, starts, gains, ticks, **more):
    return run_compensated(one, starts, gains, 1e-3, ticks, float(BAND_RAD), PUSHED, **more)


@pytest.mark.parametrize("name", NAMES)
def test_compiled_rows_are_the_plain_loops_bit_for_bit(name):
    one, starts = law_of(name), tasks.start_set("uniform", 3)
    plain = run(one, starts, Gains(np.float64(70.0), np.float64(13.0)), 200, is_plain=True)
    np.testing.assert_array_equal(run(one, starts, Gains(70.0, 13.0), 200), plain)


@pytest.mark.parametrize("name", NAMES)
def test_end_of_an_episode_is_scipys(name):
    """RK4 of 1 ms beside poles of 50/s leaves (p h)^4/120 = 5e-8 of what moves."""
    one, goal = law_of(name), ScipyRotation.from_rotvec((0.3, 1.0, -0.4))
    first = ScipyRotation.from_rotvec((-1.0, 0.2, 1.5))
    quat_wxyz, goal_wxyz = (tuple(turn.as_quat(scalar_first=True)) for turn in (first, goal))
    start = Start("one", quat_wxyz, (1.0, -2.0, 0.5), goal_wxyz)
    for seconds in (0.05, 0.2, 0.6):
        ended = run(one, [start], Gains(), round(1e3 * seconds))
        R, _, _ = motion(one, first, goal, Gains(), np.array((0.0, seconds)), start.omega, PUSHED)
        assert ended.left_rad[0] == pytest.approx(np.linalg.norm(left(R[-1], goal)), abs=1e-6)


@functools.cache
def rows(name):
    return rows_of(Settings(), Unit("compensators", selector=name, count=8, total=8, horizon_s=8.0))


@pytest.mark.parametrize("name", NAMES)
def test_disturbance_leaves_its_sine_over_kp_without_an_integral_and_nothing_with_one(name):
    one, found = law_of(name), rows(name)
    for level, off, settled in zip(found["disturbance"], found["left_rad"], found["settled"], strict=True):
        assert off == pytest.approx(0.0 if one.state.rejects else math.asin(level / Gains().kp), abs=1e-6)
        assert settled == (8 if off < BAND_RAD else 0)


@pytest.mark.parametrize("name", NAMES)
def test_rows_are_one_a_disturbance_and_within_a_stated_bound(name):
    one, found = law_of(name), rows(name)
    assert tuple(found["disturbance"]) == DISTURBANCES
    assert found["settling_median_s"].isna().equals(found["settled"] == 0)
    assert one.state.bound is None or (found["peak_u"] <= one.state.bound(*Gains())).all()
