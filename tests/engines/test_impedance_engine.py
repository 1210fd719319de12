"""The loop of impedances that shape no inertia, beside one of MuJoCo's Jacobian, numpy and scipy, and its energy."""

import mujoco
import numpy as np
import pytest
from scipy.linalg import sqrtm
from scipy.spatial.transform import Rotation

import tasks
from bench.engines.episode import FINAL_ANGLE, OUTCOME, Settings
from bench.engines.plants.impedance import ADDED, DAMPED, ELBOW, KINETIC, LEFT, STRAIN, Springs
from bench.engines.simulate_arms import run_impedance as run
from bench.law.contenders.registry import find_contender
from bench.law.control.unshaped import DAMPINGS, NULL_RATE
from bench.law.inputs import Gains
from tasks.rules import RULES
from tasks.truth import angle
from tasks.verdict import SATURATED, SETTLED

LAW = find_contender("rotation-vector")
STIFF = (2000.0, 50.0)


def settings(horizon_s=2.5, dt=1e-3, **more):
    return Settings(Gains(), dt, round(horizon_s / dt), RULES.hold_ticks(dt), **more)


def energies(rows, starts, springs):
    """Stored at the start, left at the end, and what went [J]."""
    stored = np.array([0.5 * springs.rotation * angle(one.quat_wxyz, one.goal_wxyz) ** 2 for one in starts])
    potential = 0.5 * (springs.rotation * rows[:, FINAL_ANGLE] ** 2 + springs.translation * rows[:, LEFT] ** 2)
    return stored, potential + rows[:, KINETIC], rows[:, DAMPED] + rows[:, ELBOW] - rows[:, ADDED]


@pytest.mark.parametrize("whole", [0, 1])
@pytest.mark.parametrize("arm", ["ur5e", "panda", "jaco"])
def test_arm_goes_where_a_loop_of_mujoco_numpy_and_scipy_takes_it(arm, whole):
    [start], ticks, dt, zeta = tasks.start_set("clear", 1, 0, arm), 150, 1e-3, 0.7
    [row], [end] = run(
        LAW, DAMPINGS["double-diagonalization"], Springs(*STIFF, zeta, whole), [start], settings(0.15), arm
    )
    model = mujoco.MjModel.from_xml_string(tasks.task("arm-regulation", arm).xml(dt))
    data, still, site, n = mujoco.MjData(model), mujoco.MjData(model), model.site("tool").id, model.nv
    data.qpos[:], K = start.q, np.repeat(STIFF, 3)
    goal, J, M = Rotation.from_quat(start.goal_wxyz, scalar_first=True), np.zeros((6, n)), np.zeros((n, n))
    mujoco.mj_forward(model, data)
    p_d = np.array(start.goal_p) if start.goal_p else data.site_xpos[site].copy()
    for _ in range(ticks):
        mujoco.mj_jacSite(model, data, J[:3], J[3:], site)
        mujoco.mj_fullM(model, data, M)
        still.qpos[:] = data.qpos
        mujoco.mj_forward(model, still)
        Lambda, k = np.linalg.inv(J @ np.linalg.solve(M, J.T)), np.diag(np.sqrt(K))
        D = 2.0 * zeta * k @ np.real(sqrtm(np.diag(1.0 / np.sqrt(K)) @ Lambda @ np.diag(1.0 / np.sqrt(K)))) @ k
        R = Rotation.from_matrix(data.site_xmat[site].reshape(3, 3))
        e, v = np.concatenate((p_d - data.site_xpos[site], (goal * R.inv()).as_rotvec())), J @ data.qvel
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
    R = Rotation.from_matrix(data.site_xmat[site].reshape(3, 3))
    assert row[FINAL_ANGLE] == pytest.approx((goal * R.inv()).magnitude(), rel=1e-6)


@pytest.mark.parametrize("whole", [0, 1])
@pytest.mark.parametrize("damping", DAMPINGS)
@pytest.mark.parametrize("arm", ["jaco", "panda", "puma560", "ur5e"])
def test_energy_balance_closes_and_better_with_half_the_tick(arm, damping, whole):
    starts, springs, gaps = tasks.start_set("clear", 2, 0, arm), Springs(150.0, 10.0, 1.0, whole), []
    for dt in (1e-3, 5e-4):
        rows, _ = run(LAW, DAMPINGS[damping], springs, starts, settings(dt=dt), arm)
        stored, left, gone = energies(rows, starts, springs)
        gaps.append(np.abs(left + gone - stored) / stored)
    assert np.max(gaps[0]) < 5e-4
    # of the first order in the tick; below 1e-6 terms of higher order show
    assert np.max(gaps[1]) < max(0.6 * np.max(gaps[0]), 1e-6)


@pytest.mark.parametrize("arm", ["panda", "puma560", "ur5e"])
def test_energy_never_grows_where_gravity_alone_is_compensated(arm):
    starts, springs = tasks.start_set("clear", 4, 0, arm), Springs(*STIFF, 1.0, 0)
    for horizon_s in (0.1, 0.4, 1.0):
        rows, _ = run(LAW, DAMPINGS["per-axis"], springs, starts, settings(horizon_s), arm)
        stored, left, _ = energies(rows, starts, springs)
        assert (left < stored).all()
        assert (rows[:, ADDED] == 0.0).all()
        assert (rows[:, DAMPED] > 0.0).all()
        assert (rows[:, ELBOW] >= 0.0).all()


def test_shipped_rule_diverges_on_the_panda_at_1_khz_and_settles_at_2_khz():
    starts, springs = tasks.start_set("clear", 2, 0, "panda"), Springs(*STIFF, 1.0, 0)
    for dt, outcome in ((1e-3, None), (5e-4, SETTLED)):
        rows, _ = run(LAW, DAMPINGS["diagonal"], springs, starts, settings(dt=dt), "panda")
        assert (rows[:, OUTCOME] != SETTLED).all() if outcome is None else (rows[:, OUTCOME] == outcome).all()


def test_torques_beyond_the_judges_limit_end_an_episode():
    starts, springs = tasks.start_set("clear", 1, 0, "ur5e"), Springs(*STIFF, 1.0, 0)
    rows, _ = run(LAW, DAMPINGS["per-axis"], springs, starts, settings(torque_limit=0.5), "ur5e")
    assert rows[0, OUTCOME] == SATURATED
    assert rows[0, STRAIN] > 0.0
