"""The task of arms: names, the plant against MuJoCo by hand, what a varied plant is."""

import mujoco
import numpy as np
import pytest

import tasks
from tasks.episode import INTEGRATORS
from tasks.kinematics import kinematics

on_every_arm = pytest.mark.parametrize("arm", tasks.arm_names())


def first(arm, name="tumbling"):
    return tasks.start_set(name, 1, arm=arm)[0]


# ----------------------------------------------------------------------------------------------- names


def test_pairs_are_the_free_body_and_every_arm():
    assert sorted(tasks.pairs()) == sorted([("free-body", ""), *(("arm-regulation", arm) for arm in tasks.arm_names())])
    assert [tasks.is_for_arms(name) for name in ("arm-regulation", "free-body")] == [True, False]


def test_first_start_is_the_default():
    environment = tasks.load("arm-regulation", arm="ur5e")
    assert environment.task.start == tasks.start_set("clear", 1, arm="ur5e")[0]


# ------------------------------------------------------------------------------------------- the plant


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
