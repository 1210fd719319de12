"""Rows of goal streams, limiters, gains at equal peak and laws with a state, each against a closed form or scipy."""

import functools
import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bodies import left, motion
from support.states import directions

import tasks
from bench.engines.simulate_bodies import run_compensated, run_stream
from bench.experiments.compensators import BAND_RAD, DISTURBANCES, law_of
from bench.experiments.experiment import Unit, rows_of
from bench.experiments.limiters import LIMITERS
from bench.experiments.request import Request
from bench.experiments.suites import STREAMED
from bench.law.contenders.registry import contenders, find_contender
from bench.law.inputs import PAPERS_GAINS, Gains
from tasks.base import Start
from tasks.rotations import about

AXIS, RATE, DT = (0.0, 0.0, 1.0), 0.5, 1e-3


@functools.cache
def of_streams():
    return rows_of(Request("quick"), Unit("goal-streams", count=1, total=1)).set_index(["stream", "law"])


def test_body_behind_a_turning_goal_lags_as_the_linear_loop():
    truth = np.array([about(AXIS, RATE * k * DT) for k in range(1500)])
    _, off, _ = run_stream(find_contender("rotation-vector"), truth, truth, PAPERS_GAINS, DT)
    kp, kv = PAPERS_GAINS
    found = solve_ivp(lambda _, x: (x[1], -kp * x[0] - kv * (x[1] + RATE)), (0.0, 1.5), (0.0, -RATE), rtol=1e-9)
    assert off == pytest.approx(np.abs(found.y[0]).max(), rel=0.02)
    assert off == pytest.approx(RATE * kv / kp, rel=0.02)


@pytest.mark.parametrize("law", STREAMED)
def test_law_on_matrices_sees_no_sign(law):
    right = of_streams().loc[("log", law)]
    np.testing.assert_allclose(of_streams().loc[("slerp-continued", law)].to_numpy(), right.to_numpy(), rtol=1e-9)
    for name in ("rotation-vector-continued", "quaternion-continued"):
        np.testing.assert_allclose(of_streams().loc[(name, law)].to_numpy(), right.to_numpy(), rtol=0.02)


def test_spring_on_the_quaternion_as_it_came_unwinds_where_its_sign_flips():
    raw = of_streams().xs("", level="law")
    assert (raw.loc[["quaternion", "slerp"], "way_ratio"] > 1.5).all()
    assert (raw.loc[["quaternion-continued", "slerp-continued"], "way_ratio"] < 1.0).all()
    assert (raw.loc[["quaternion", "slerp"], "off_rad"] > math.radians(150.0)).all()


def test_flip_raises_every_laws_peak_tenfold():
    peaks = of_streams()["peak_u"].drop("", level="law").unstack("stream")
    assert (peaks[["rotation-vector", "quaternion", "slerp"]].min(axis=1) > 10.0 * peaks["log"]).all()


K = 10.0


@pytest.mark.parametrize("limiter", LIMITERS.values(), ids=LIMITERS)
def test_limiter_is_odd_passes_the_middle_of_its_range_and_lengthens_and_reverses_no_component(limiter):
    for omega in directions(200, 5) * np.geomspace(1e-4, 40.0, 200)[:, None]:
        limited = np.array(limiter.limit(tuple(omega), K))
        assert (limited * omega >= 0.0).all()
        assert (np.abs(limited) <= np.abs(omega)).all()
        np.testing.assert_array_equal(limited, -np.array(limiter.limit(tuple(-omega), K)))
    assert limiter.limit((0.5, -0.6, 0.7), K) == (0.5, -0.6, 0.7)


def test_deadband_is_of_the_error_whatever_the_gain():
    limit = LIMITERS["deadband"].limit
    for gain in (1.0, 10.0, 300.0):
        assert limit((gain * 4.9e-3, gain * 5.1e-3, -gain * 4.9e-3), gain) == (0.0, gain * 5.1e-3, 0.0)


NAMES = ("", *contenders("compensators"))
PUSHED = (3.0, -4.0, 2.0)


def pushed(one, starts, gains, ticks, **more):
    return run_compensated(one, starts, gains, 1e-3, ticks, float(BAND_RAD), PUSHED, **more)


@pytest.mark.parametrize("name", NAMES)
def test_compiled_rows_are_the_plain_loops_bit_for_bit(name):
    one, starts = law_of(name), tasks.start_set("uniform", 3)
    plain = pushed(one, starts, Gains(np.float64(70.0), np.float64(13.0)), 200, is_plain=True)
    np.testing.assert_array_equal(pushed(one, starts, Gains(70.0, 13.0), 200), plain)


@pytest.mark.parametrize("name", NAMES)
def test_end_of_an_episode_is_scipys(name):
    """RK4 of 1 ms beside poles of 50/s leaves (p h)^4/120 = 5e-8 of what moves."""
    one, goal = law_of(name), ScipyRotation.from_rotvec((0.3, 1.0, -0.4))
    first = ScipyRotation.from_rotvec((-1.0, 0.2, 1.5))
    quat_wxyz, goal_wxyz = (tuple(turn.as_quat(scalar_first=True)) for turn in (first, goal))
    start = Start("one", quat_wxyz, (1.0, -2.0, 0.5), goal_wxyz)
    for seconds in (0.05, 0.2, 0.6):
        _, left_rad, _ = pushed(one, [start], Gains(), round(1e3 * seconds))
        R, _, _ = motion(one, first, goal, Gains(), np.array((0.0, seconds)), start.omega, PUSHED)
        assert left_rad[0] == pytest.approx(np.linalg.norm(left(R[-1], goal)), abs=1e-6)


@functools.cache
def of_compensator(name):
    return rows_of(Request(), Unit("compensators", selector=name, count=8, total=8, horizon_s=8.0))


@pytest.mark.parametrize("name", NAMES)
def test_disturbance_leaves_its_sine_over_kp_without_an_integral_and_nothing_with_one(name):
    one, found = law_of(name), of_compensator(name)
    for level, off, settled in zip(found["disturbance"], found["left_rad"], found["settled"], strict=True):
        assert off == pytest.approx(0.0 if one.rejects else math.asin(level / Gains().kp), abs=1e-6)
        assert settled == (8 if off < BAND_RAD else 0)


@pytest.mark.parametrize("name", NAMES)
def test_rows_are_one_a_disturbance_and_within_a_stated_bound(name):
    one, found = law_of(name), of_compensator(name)
    assert tuple(found["disturbance"]) == DISTURBANCES
    assert found["settling_median_s"].isna().equals(found["settled"] == 0)
    assert one.bound is None or (found["peak_u"] <= one.bound(*Gains())).all()
