"""The plants of tasks: a free body against (2.6) and (2.7) of the paper, arms against MuJoCo stepped by hand."""

import math

import mujoco
import numpy as np
import pytest
from dm_control.rl.control import PhysicsError
from scipy.spatial.transform import Rotation
from support.states import rotation

import tasks
from tasks.base import IDENTITY, Start
from tasks.episode import INTEGRATORS
from tasks.kinematics import kinematics

on_every_arm = pytest.mark.parametrize("arm", tasks.arm_names())


def first(arm, name="tumbling"):
    return tasks.start_set(name, 1, arm=arm)[0]


def test_pairs_are_the_free_body_and_every_arm():
    assert sorted(tasks.pairs()) == sorted([("free-body", ""), *(("arm-regulation", arm) for arm in tasks.arm_names())])
    assert [tasks.is_for_arms(name) for name in ("arm-regulation", "free-body")] == [True, False]


def test_first_start_is_the_default():
    environment = tasks.load("arm-regulation", arm="ur5e")
    assert environment.task.start == tasks.start_set("clear", 1, arm="ur5e")[0]


@on_every_arm
@pytest.mark.parametrize("integrator", sorted(INTEGRATORS))
def test_episode_is_mujoco_stepped_by_hand_bit_for_bit(arm, integrator):
    """mj_step1 | command | mj_step2, mj_step1 | ...; with RK4 mj_step, then mj_step1."""
    start, dt = first(arm), 2e-3
    one = tasks.arm(arm)
    torques = np.random.default_rng(4).uniform(-0.2, 0.2, size=(60, one.joints)) * np.array(one.rated)
    environment = tasks.load("arm-regulation", start, dt, integrator=integrator, arm=arm)
    seen = [environment.reset().observation] + [environment.step(tau).observation for tau in torques]

    model = mujoco.MjModel.from_xml_string(tasks.task("arm-regulation", arm).xml(dt))
    model.opt.integrator = INTEGRATORS[integrator]
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = start.q, start.qdot
    mujoco.mj_step1(model, data)
    for i in range(len(torques) + 1):
        assert data.qpos.tolist() == seen[i]["q"].tolist(), i
        assert data.qvel.tolist() == seen[i]["qdot"].tolist(), i
        assert data.sensordata[0:9].tolist() == seen[i]["R"].tolist(), i
        assert data.sensordata[9:12].tolist() == seen[i]["omega"].tolist(), i
        assert data.sensordata[16:19].tolist() == seen[i]["p"].tolist(), i
        if i < len(torques):
            data.ctrl[:] = torques[i]
            if integrator == "rk4":
                mujoco.mj_step(model, data)
            else:
                mujoco.mj_step2(model, data)
            mujoco.mj_step1(model, data)


def test_varied_plant_is_what_moves_and_the_task_stays_what_it_was():
    def heavier(model):
        model.body_mass[:] *= 1.2
        model.body_inertia[:] *= 1.2

    start = first("ur5e", "clear")
    seen = {}
    for word, vary in (("nominal", None), ("heavier", heavier)):
        environment = tasks.load("arm-regulation", start, arm="ur5e", vary=vary)
        environment.reset()
        seen[word] = np.array(environment.physics.data.qfrc_bias)
    np.testing.assert_allclose(seen["heavier"], 1.2 * seen["nominal"], rtol=1e-12, atol=1e-14)
    again = tasks.load("arm-regulation", start, arm="ur5e")
    again.reset()
    assert np.array_equal(again.physics.data.qfrc_bias, seen["nominal"])


def test_task_of_the_callers_own_on_an_arm_is_loaded():
    own = tasks.task("arm-regulation", "ur5e")._replace(name="own")
    home = tasks.arm("ur5e").home
    environment = tasks.load(own, kinematics(tasks.arm("ur5e")).start("home", home, (1.0, 0.0, 0.0, 0.0)))
    assert environment.task.task.name == "own"
    assert environment.reset().observation["q"].tolist() == list(home)


DT = 1e-3
TUMBLING = tasks.start_set("tumbling", 10)


def matrix(observation):
    return observation["R"].reshape(3, 3).T


@pytest.mark.parametrize("integrator", ["euler", "implicit", "implicitfast"])
def test_angular_velocity_changes_by_dt_u_and_a_step_turns_with_the_new_one(integrator):
    """R' = exp(dt [omega']x) R with omega' = omega + dt u, as the module says."""
    for start in TUMBLING:
        environment = tasks.load("free-body", start, integrator=integrator)
        before = environment.reset().observation
        for u in np.vstack(((400.0, -300.0, 200.0), np.random.default_rng(1).normal(scale=50.0, size=(20, 3)))):
            after = environment.step(u).observation
            np.testing.assert_allclose(after["omega"] - before["omega"], DT * u, rtol=0, atol=1e-13)
            expected = Rotation.from_rotvec(DT * (before["omega"] + DT * u)).as_matrix() @ matrix(before)
            np.testing.assert_allclose(matrix(after), expected, rtol=0, atol=2e-15)
            before = after


def test_angular_velocity_changes_by_dt_u_to_third_order_under_rk4():
    """MuJoCo averages body-frame rates over the tick: off by less than dt^3 |omega|^2 |u|, and by
    8 times less at half the step."""
    u = np.array([60.0, -40.0, 20.0])
    for start in TUMBLING:
        errors = []
        for dt in (2e-3, 1e-3):
            environment = tasks.load("free-body", start, dt=dt, integrator="rk4")
            environment.reset()
            change = environment.step(u).observation["omega"] - np.array(start.omega)
            errors.append(np.linalg.norm(change - dt * u))
            assert errors[-1] < dt**3 * (math.hypot(*start.omega) + 1.0) ** 2 * np.linalg.norm(u)
        assert errors[0] / errors[1] == pytest.approx(8.0, rel=0.1)


@pytest.mark.parametrize("integrator", ["euler", "rk4", "implicit", "implicitfast"])
def test_free_rotation_is_the_matrix_exponential_and_momentum_is_conserved(integrator):
    for start in TUMBLING:
        environment = tasks.load("free-body", start, integrator=integrator)
        environment.reset()
        for _ in range(500):
            observation = environment.step([0.0, 0.0, 0.0]).observation
        turned = Rotation.from_rotvec(0.5 * np.array(start.omega))
        expected = turned * rotation(start.quat_wxyz)
        # 500 products of quaternions, each rounded to about 1e-16 and adding up at worst
        np.testing.assert_allclose(matrix(observation), expected.as_matrix(), rtol=0, atol=5e-13)
        np.testing.assert_allclose(observation["omega"], start.omega, rtol=0, atol=1e-12)


def test_diverged_body_is_not_put_back_by_the_simulator():
    """1e11 rad/s is beyond MuJoCo's own limit of 1e10, at which autoreset would put the body back at rest."""
    environment = tasks.load("free-body", Start("diverged", IDENTITY, omega=(1e11, 0.0, 0.0)))
    assert environment.reset().observation["omega"].tolist() == [1e11, 0.0, 0.0]
    with pytest.raises(PhysicsError, match="mjWARN_BADQVEL"):
        environment.step([0.0, 0.0, 0.0])
    assert environment.physics.omega()[0] == pytest.approx(1e11)


@pytest.mark.parametrize("name", ["half-turn", "poles", "wraps"])
def test_exact_starts_reach_mujoco_unrounded(name):
    for start in tasks.start_set(name):
        if "exact" in start.id:
            environment = tasks.load("free-body", start)
            environment.reset()
            assert environment.physics.quat_wxyz() == start.quat_wxyz
