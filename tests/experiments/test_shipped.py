"""Controllers as they are shipped: what is felt against closed forms, settling against scipy's integrator."""

import dataclasses
import functools
import math

import numpy as np
import pandas as pd
import pytest
from scipy.integrate import solve_ivp

from bench.experiments import shipped as measured
from bench.experiments.request import Request
from bench.experiments.shipped import compare
from bench.law import kernel
from bench.law.contenders.registry import contenders
from bench.law.shipped import law_of
from tasks.rules import RULES

HORIZON_S = 20.0


@functools.cache
def rows() -> pd.DataFrame:
    """All of the controllers, without laws of ours."""
    made = [row for one in contenders("shipped").values() for row in compare(one, (), Request(), HORIZON_S)]
    return pd.DataFrame(made).set_index("shipped")


@pytest.mark.parametrize(
    ("name", "ratio", "damping"),
    [
        ("franka-ros", 0.5, math.sqrt(2.0)),
        ("libfranka", 0.5, math.sqrt(2.0)),
        ("deoxys", 0.5, math.sqrt(2.0)),
        ("isaac-gym", 0.5, math.sqrt(2.0)),
        ("serl-franka", 0.5, 7.0 / (2.0 * math.sqrt(75.0))),
        ("robosuite", 1.0, 1.0),
        ("crisp", 1.0, 1.0),
        ("mjctrl-opspace", 0.95, 1.0 / math.sqrt(0.95)),
        ("ros2-admittance", 1.0, 2.828427),
    ],
)
def test_stiffness_and_damping_felt_are_the_closed_forms(name, ratio, damping):
    found = rows().loc[name]
    assert found["stiffness_50mrad"] == pytest.approx(ratio, rel=1e-3)  # 0.05^2/6 of a sine is 4e-4
    assert found["damping_ratio"] == pytest.approx(damping, rel=1e-3)


def moved(name: str, angle: float, inertia: float = 1.0):
    """Angle over time about the base's x, by scipy: I thetadotdot = -K e - D thetadot."""
    one = contenders("shipped")[name]

    def rate(_, state):
        e = one.error((math.cos(state[0] / 2.0), math.sin(state[0] / 2.0), 0.0, 0.0))[0]
        return (state[1], (-one.gains.kp * e - one.gains.kv * state[1]) / inertia)

    return solve_ivp(rate, (0.0, HORIZON_S), (angle, 0.0), rtol=1e-10, atol=1e-14, dense_output=True).sol


def test_critical_inertia_is_where_a_body_that_scipy_moves_begins_to_overshoot():
    critical = rows().loc["franka-ros", "critical"]
    assert critical == pytest.approx(2.0, rel=1e-3)
    times = np.linspace(0.0, HORIZON_S, 4000)
    assert moved("franka-ros", 0.1, 0.9 * critical)(times)[0].min() > -1e-9
    assert moved("franka-ros", 0.1, 1.5 * critical)(times)[0].min() < -1e-6


@pytest.mark.parametrize("name", ["franka-ros", "serl-franka", "robosuite", "crisp"])
def test_settling_time_is_that_of_a_body_that_scipy_moves(name):
    angle, times = math.radians(150.0), np.arange(0.0, HORIZON_S, 1e-3)
    theta = moved(name, angle)(times)[0]
    about_x = times[np.flatnonzero(np.abs(theta) > RULES.band_rad(angle))[-1] + 1]
    found = rows().loc[name, "settling_150_s"]
    # the slowest of all axes is no faster; a clip per axis is slowest about a base axis
    assert found == pytest.approx(about_x, abs=0.02)


def test_dead_points_are_where_the_sign_of_zero_is_zero_and_where_the_sine_is_and_none_unwinds():
    found = rows()["dead"]
    assert set(found[found > 0].index) == {"isaac-gym", "robosuite"}
    assert set(found[found > 0]) == {measured.DIRECTIONS}
    assert not rows()["away"].any()


def test_sine_leaves_its_dead_point_by_a_decade_as_linearized():
    one, found = contenders("shipped")["robosuite"], rows().loc["robosuite"]
    away = (-one.gains.kv + math.sqrt(one.gains.kv**2 + 4.0 * one.gains.kp)) / 2.0
    decades = math.log10(math.radians(0.1) / measured.BEFORE_180_RAD)
    waited = found["settling_near_180_s"] - found["settling_179_9_s"]
    assert waited == pytest.approx(decades * math.log(10.0) / away, rel=0.05)


@kernel
def bare(q):
    """eps, without a sign."""
    return (q[1], q[2], q[3])


def test_error_without_a_sign_is_found_to_unwind_from_the_antipode():
    one = contenders("shipped")["franka-ros"]
    law = one.law._replace(name="no-sign", law=law_of(bare))
    one = dataclasses.replace(one, law=law, error=bare)
    [found] = compare(one, (), Request(), HORIZON_S)
    assert found["away"] > 0
    assert "double-cover" in found["findings"] or "long-way" in found["findings"]


def test_audit_agrees_with_what_is_measured():
    found = rows()
    says = {word: found["findings"].str.contains(word) for word in ("stiffness", "deadband", "dead-at-180", "clip")}
    bends = found[[f"bent_{angle}_rad" for angle in (10, 30, 90, 150)]].max(axis=1) > 1e-3
    felt = found["stiffness_50mrad"].where(found["stiffness_1mrad"] == 0.0, found["stiffness_1mrad"])
    pd.testing.assert_series_equal(says["stiffness"], (felt - 1.0).abs() > 1e-3, check_names=False)
    pd.testing.assert_series_equal(says["deadband"], found["stiffness_1mrad"] == 0.0, check_names=False)
    pd.testing.assert_series_equal(says["dead-at-180"], found["dead"] > 0, check_names=False)
    bent = found["findings"].str.contains("axis-clip|deadband")
    pd.testing.assert_series_equal(bent, bends, check_names=False)
