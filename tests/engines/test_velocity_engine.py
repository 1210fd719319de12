"""Loops that tell robots velocities, beside closed forms and a loop of MuJoCo's Jacobian and numpy's pseudo-inverse."""

import math

import mujoco
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import tasks
from bench.engines.episode import FINAL_ANGLE, SETTLING_TICK, TICKS, Settings
from bench.engines.plants.velocity import BENT, OFF, PATH, PEAK, RATE
from bench.engines.simulate_arms import run_velocity as run
from bench.experiments.limiters import GREATEST_RATE, clamp_axes, clamp_norm, drop_small_errors, pass_all
from bench.law.contenders.registry import find_contender
from bench.law.inputs import Gains
from tasks.base import Start
from tasks.rotations import about
from tasks.truth import angle

NONE, K, DT = pass_all, 10.0, 1e-3


def settings(ticks=2500, hold_ticks=250, dt=DT):
    return Settings(Gains(), dt, ticks, hold_ticks)


def turned_by(rad, axis=(1.0, 2.0, 3.0)):
    return [Start("", about(axis, rad))]


@pytest.mark.parametrize("rad", [1e-6, 0.3, 2.0, 3.1, math.pi])
@pytest.mark.parametrize("ticks", [1, 7, 100])
def test_logarithm_takes_k_dt_of_the_angle_at_every_tick(rad, ticks):
    [row] = run(find_contender("rotation-vector"), NONE, K, turned_by(rad), settings(ticks, ticks + 1))
    left = (1.0 - K * DT) ** ticks
    assert row[FINAL_ANGLE] == pytest.approx(rad * left, rel=1e-11, abs=1e-15)
    assert row[PATH] == pytest.approx(rad * (1.0 - left), rel=1e-11)
    assert row[PEAK] == pytest.approx(K * rad, rel=1e-11)


def test_sine_follows_its_closed_form_as_ticks_shorten():
    """theta' = -K sin(theta): tan(theta/2) = tan(theta_0/2) exp(-K t)."""
    dt, time = 1e-5, 0.2
    [row] = run(find_contender("rotation-matrix"), NONE, K, turned_by(3.0), settings(round(time / dt), 10**6, dt))
    expected = 2.0 * math.atan(math.tan(1.5) * math.exp(-K * time))
    assert row[FINAL_ANGLE] == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize("rad", [1.0, 3.0])
def test_norm_clamp_settles_at_its_closed_form(rad):
    """At the bound b until theta = b/K, then theta = (b/K) exp(-K t), to 2 % of the beginning."""
    [row] = run(find_contender("rotation-vector"), clamp_norm, K, turned_by(rad), settings())
    knee = GREATEST_RATE / K
    expected = (rad - knee) / GREATEST_RATE + math.log(knee / (0.02 * rad)) / K
    assert row[SETTLING_TICK] * DT == pytest.approx(expected, abs=3e-3)
    assert row[BENT] < 1e-7
    assert row[PATH] == pytest.approx(rad, rel=1e-3)


def test_clamp_per_axis_bends_the_command_by_the_angle_between():
    omega = K * 3.0 * np.array((1.0, 2.0, 3.0)) / math.sqrt(14.0)  # all three components are cut: (b, b, b)
    expected = math.acos(omega.sum() / (math.sqrt(3.0) * np.linalg.norm(omega)))
    [row] = run(find_contender("rotation-vector"), clamp_axes, K, turned_by(3.0), settings(1))
    assert row[BENT] == pytest.approx(expected, rel=1e-9)


def test_deadband_leaves_less_than_its_diagonal():
    [row] = run(find_contender("rotation-vector"), drop_small_errors, K, turned_by(2.0), settings())
    assert 1e-3 < row[FINAL_ANGLE] < 5e-3 * math.sqrt(3.0)


@pytest.mark.parametrize("arm", ["ur5e", "panda"])
def test_arm_goes_where_a_loop_of_mujoco_and_numpy_takes_it(arm):
    """q += dt pinv(J) (K (p_d - p), K log(R_d R^T)), by mj_jacSite and scipy's rotation vector, for 200 ticks."""
    start, ticks = tasks.start_set("clear", 1, 0, arm)[0], 200
    one = find_contender("rotation-vector@geometric+pseudo-inverse")
    [row] = run(one, NONE, K, [start], settings(ticks, ticks + 1), arm)
    model = mujoco.MjModel.from_xml_string(tasks.task("arm-regulation", arm).xml(DT))
    data, site = mujoco.MjData(model), model.site("tool").id
    data.qpos[:] = start.q
    mujoco.mj_kinematics(model, data)
    p_d, goal = data.site_xpos[site].copy(), Rotation.from_quat(start.goal_wxyz, scalar_first=True)
    J, rate = np.zeros((6, model.nv)), 0.0
    for _ in range(ticks):
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_jacSite(model, data, J[:3], J[3:], site)
        R = Rotation.from_matrix(data.site_xmat[site].reshape(3, 3))
        error = np.concatenate((p_d - data.site_xpos[site], (goal * R.inv()).as_rotvec()))
        qdot = np.linalg.pinv(J) @ (K * error)
        rate = max(rate, np.linalg.norm(qdot))
        data.qpos[:] += DT * qdot
    mujoco.mj_kinematics(model, data)
    quat = Rotation.from_matrix(data.site_xmat[site].reshape(3, 3)).as_quat(scalar_first=True)
    assert row[TICKS] == ticks
    assert row[FINAL_ANGLE] == pytest.approx(angle(tuple(quat), start.goal_wxyz), rel=1e-6)
    assert row[RATE] == pytest.approx(rate, rel=1e-6)
    assert 0.0 <= row[OFF] < 0.05


def test_inverses_that_differ_by_inertia_alone_are_one_where_there_is_none():
    start = tasks.start_set("clear", 2, 0, "panda")
    words = ("pseudo-inverse", "dynamically-consistent")
    first, second = (
        run(find_contender(f"rotation-vector@geometric+{word}"), NONE, K, start, settings(300), "panda", 0.05)
        for word in words
    )
    np.testing.assert_allclose(first, second, rtol=1e-9, atol=1e-12)
