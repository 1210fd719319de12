"""Loops of velocities and of unshaped impedances, beside closed forms and loops of MuJoCo, numpy and scipy."""

import math

import mujoco
import numpy as np
import pytest
from scipy.linalg import sqrtm
from scipy.spatial.transform import Rotation
from support.buffers import inertia_of, jacobian_of, state_of
from support.driving import settings

import tasks
from bench.engines.episode import FINAL_ANGLE, OUTCOME, SETTLING_TICK, TICKS
from bench.engines.plants.impedance import ADDED, DAMPED, ELBOW, KINETIC, LEFT, STRAIN, Springs
from bench.engines.plants.velocity import BENT, OFF, PATH, PEAK, RATE
from bench.engines.simulate_arms import run_impedance, run_velocity
from bench.experiments.limiters import GREATEST_RATE, clamp_axes, clamp_norm, drop_small_errors, pass_all
from bench.law.contenders.registry import find_contender
from bench.law.control.unshaped import DAMPINGS, NULL_RATE
from tasks.base import Start
from tasks.rotations import about
from tasks.rules import RULES
from tasks.truth import angle
from tasks.verdict import SATURATED

NONE, K, DT = pass_all, 10.0, 1e-3


def judged(horizon_s=2.5, dt_s=DT, **more):
    return settings(dt_s, horizon_s, RULES.hold_ticks(dt_s), **more)


def rotation_of(data):
    """Return the tool's rotation."""
    return Rotation.from_matrix(data.site("tool").xmat.reshape(3, 3))


def turned_by(rad, axis=(1.0, 2.0, 3.0)):
    return [Start("", about(axis, rad))]


@pytest.mark.parametrize("rad", [1e-6, 0.3, 2.0, 3.1, math.pi])
@pytest.mark.parametrize("ticks", [1, 7, 100])
def test_logarithm_takes_k_dt_of_the_angle_at_every_tick(rad, ticks):
    [row] = run_velocity(find_contender("rotation-vector"), NONE, K, turned_by(rad), settings(horizon_s=ticks * DT))
    left = (1.0 - K * DT) ** ticks
    assert row[FINAL_ANGLE] == pytest.approx(rad * left, rel=1e-11, abs=1e-15)
    assert row[PATH] == pytest.approx(rad * (1.0 - left), rel=1e-11)
    assert row[PEAK] == pytest.approx(K * rad, rel=1e-11)


def test_sine_follows_its_closed_form_as_ticks_shorten():
    """theta' = -K sin(theta): tan(theta/2) = tan(theta_0/2) exp(-K t)."""
    time = 0.2
    [row] = run_velocity(find_contender("rotation-matrix"), NONE, K, turned_by(3.0), settings(1e-5, time))
    expected = 2.0 * math.atan(math.tan(1.5) * math.exp(-K * time))
    assert row[FINAL_ANGLE] == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize("rad", [1.0, 3.0])
def test_norm_clamp_settles_at_its_closed_form(rad):
    """At the bound b until theta = b/K, then theta = (b/K) exp(-K t), to 2 % of the beginning."""
    [row] = run_velocity(find_contender("rotation-vector"), clamp_norm, K, turned_by(rad), judged())
    knee = GREATEST_RATE / K
    expected = (rad - knee) / GREATEST_RATE + math.log(knee / (0.02 * rad)) / K
    assert row[SETTLING_TICK] * DT == pytest.approx(expected, abs=3e-3)
    assert row[BENT] < 1e-7
    assert row[PATH] == pytest.approx(rad, rel=1e-3)


def test_clamp_per_axis_bends_the_command_by_the_angle_between():
    omega = K * 3.0 * np.array((1.0, 2.0, 3.0)) / math.sqrt(14.0)  # all three components are cut: (b, b, b)
    expected = math.acos(omega.sum() / (math.sqrt(3.0) * np.linalg.norm(omega)))
    [row] = run_velocity(find_contender("rotation-vector"), clamp_axes, K, turned_by(3.0), settings(horizon_s=DT))
    assert row[BENT] == pytest.approx(expected, rel=1e-9)


def test_deadband_leaves_less_than_its_diagonal():
    [row] = run_velocity(find_contender("rotation-vector"), drop_small_errors, K, turned_by(2.0), judged())
    assert 1e-3 < row[FINAL_ANGLE] < 5e-3 * math.sqrt(3.0)


@pytest.mark.parametrize("arm", ["ur5e", "panda"])
def test_arm_goes_where_a_loop_of_mujoco_and_numpy_takes_it(arm):
    """q += dt pinv(J) (K (p_d - p), K log(R_d R^T)), by mj_jacSite and scipy's rotation vector, for 200 ticks."""
    start, ticks = tasks.start_set("clear", 1, 0, arm)[0], 200
    one = find_contender("rotation-vector@geometric+pseudo-inverse")
    [row] = run_velocity(one, NONE, K, [start], settings(horizon_s=ticks * DT), arm)
    model = mujoco.MjModel.from_xml_string(tasks.task("arm-regulation", arm).xml(DT))
    data, goal, rate = state_of(model, start.q), Rotation.from_quat(start.goal_wxyz, scalar_first=True), 0.0
    p_d = data.site("tool").xpos.copy()
    for _ in range(ticks):
        error = np.concatenate((p_d - data.site("tool").xpos, (goal * rotation_of(data).inv()).as_rotvec()))
        qdot = np.linalg.pinv(jacobian_of(model, data, "tool")) @ (K * error)
        rate = max(rate, np.linalg.norm(qdot))
        data = state_of(model, data.qpos + DT * qdot)
    quat = rotation_of(data).as_quat(scalar_first=True)
    assert row[TICKS] == ticks
    assert row[FINAL_ANGLE] == pytest.approx(angle(tuple(quat), start.goal_wxyz), rel=1e-6)
    assert row[RATE] == pytest.approx(rate, rel=1e-6)
    assert 0.0 <= row[OFF] < 0.05


def test_inverses_that_differ_by_inertia_alone_are_one_where_there_is_none():
    start = tasks.start_set("clear", 2, 0, "panda")
    words = ("pseudo-inverse", "dynamically-consistent")
    first, second = (
        run_velocity(find_contender(f"rotation-vector@geometric+{word}"), NONE, K, start, judged(0.3), "panda", 0.05)
        for word in words
    )
    np.testing.assert_allclose(first, second, rtol=1e-9, atol=1e-12)


LAW = find_contender("rotation-vector")
STIFF = (2000.0, 50.0)


def energies(rows, starts, springs):
    """Stored at the start, left at the end, and what went [J]."""
    stored = np.array([0.5 * springs.rotation * angle(one.quat_wxyz, one.goal_wxyz) ** 2 for one in starts])
    potential = 0.5 * (springs.rotation * rows[:, FINAL_ANGLE] ** 2 + springs.translation * rows[:, LEFT] ** 2)
    return stored, potential + rows[:, KINETIC], rows[:, DAMPED] + rows[:, ELBOW] - rows[:, ADDED]


@pytest.mark.parametrize("whole", [0, 1])
@pytest.mark.parametrize("arm", ["ur5e", "panda", "jaco"])
def test_arm_goes_where_a_loop_of_mujoco_numpy_and_scipy_takes_it(arm, whole):
    [start], ticks, dt, zeta = tasks.start_set("clear", 1, 0, arm), 150, 1e-3, 0.7
    [row], [end] = run_impedance(
        LAW, DAMPINGS["double-diagonalization"], Springs(*STIFF, zeta, whole), [start], judged(0.15), arm
    )
    model = mujoco.MjModel.from_xml_string(tasks.task("arm-regulation", arm).xml(dt))
    data, n, K = state_of(model, start.q), model.nv, np.repeat(STIFF, 3)
    goal, tool = Rotation.from_quat(start.goal_wxyz, scalar_first=True), data.site("tool")
    p_d = np.array(start.goal_p) if start.goal_p else tool.xpos.copy()
    for _ in range(ticks):
        J, M, still = jacobian_of(model, data, "tool"), inertia_of(model, data), state_of(model, data.qpos)
        Lambda, k = np.linalg.inv(J @ np.linalg.solve(M, J.T)), np.diag(np.sqrt(K))
        D = 2.0 * zeta * k @ np.real(sqrtm(np.diag(1.0 / np.sqrt(K)) @ Lambda @ np.diag(1.0 / np.sqrt(K)))) @ k
        e, v = np.concatenate((p_d - tool.xpos, (goal * rotation_of(data).inv()).as_rotvec())), J @ data.qvel
        tau = J.T @ (K * e - D @ v) + still.qfrc_bias
        if whole:
            tau += data.qfrc_bias - data.qfrc_passive - still.qfrc_bias
        if n > 6:
            tau -= NULL_RATE * (M @ data.qvel - J.T @ Lambda @ v)
        data.ctrl[:] = tau
        mujoco.mj_step(model, data)
        mujoco.mj_forward(model, data)
    np.testing.assert_allclose(end[:n], data.qpos, atol=1e-7)
    np.testing.assert_allclose(end[n:], data.qvel, atol=1e-5)
    assert row[FINAL_ANGLE] == pytest.approx((goal * rotation_of(data).inv()).magnitude(), rel=1e-6)


@pytest.mark.parametrize("whole", [0, 1])
@pytest.mark.parametrize("damping", DAMPINGS)
@pytest.mark.parametrize("arm", ["jaco", "panda", "puma560", "ur5e"])
def test_energy_balance_closes_and_better_with_half_the_tick(arm, damping, whole):
    starts, springs, gaps = tasks.start_set("clear", 2, 0, arm), Springs(150.0, 10.0, 1.0, whole), []
    for dt in (1e-3, 5e-4):
        rows, _ = run_impedance(LAW, DAMPINGS[damping], springs, starts, judged(dt_s=dt), arm)
        stored, left, gone = energies(rows, starts, springs)
        gaps.append(np.abs(left + gone - stored) / stored)
    assert np.max(gaps[0]) < 5e-4
    # of the first order in the tick; below 1e-6 terms of higher order show
    assert np.max(gaps[1]) < max(0.6 * np.max(gaps[0]), 1e-6)


@pytest.mark.parametrize("arm", ["panda", "puma560", "ur5e"])
def test_energy_never_grows_where_gravity_alone_is_compensated(arm):
    starts, springs = tasks.start_set("clear", 4, 0, arm), Springs(*STIFF, 1.0, 0)
    for horizon_s in (0.1, 0.4, 1.0):
        rows, _ = run_impedance(LAW, DAMPINGS["per-axis"], springs, starts, judged(horizon_s), arm)
        stored, left, _ = energies(rows, starts, springs)
        assert (left < stored).all()
        assert (rows[:, ADDED] == 0.0).all()
        assert (rows[:, DAMPED] > 0.0).all()
        assert (rows[:, ELBOW] >= 0.0).all()


def test_torques_beyond_the_judges_limit_end_an_episode():
    starts, springs = tasks.start_set("clear", 1, 0, "ur5e"), Springs(*STIFF, 1.0, 0)
    rows, _ = run_impedance(LAW, DAMPINGS["per-axis"], springs, starts, judged(torque_limit=0.5), "ur5e")
    assert rows[0, OUTCOME] == SATURATED
    assert rows[0, STRAIN] > 0.0
