"""The task of arms: names and refusals, the plant against MuJoCo by hand, what a varied plant is."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import mujoco
import numpy as np
import pytest

import tasks
from tasks.base import ArmTask, BadValue, Start, Task, UnknownName
from tasks.episode import INTEGRATORS

on_every_arm = pytest.mark.parametrize("arm", tasks.arm_names())


def first(arm, name="tumbling"):
    return tasks.start_set(name, 1, arm=arm)[0]


# ------------------------------------------------------------------------------------ names, refusals


def test_pairs_are_the_free_body_and_every_arm():
    assert ("free-body", "") in tasks.pairs()
    assert [arm for task, arm in tasks.pairs() if task == "arm-regulation"] == tasks.arm_names()


def test_task_for_arms_says_so():
    assert tasks.is_for_arms("arm-regulation")
    assert not tasks.is_for_arms("free-body")


@on_every_arm
def test_task_knows_its_arm(arm):
    one = tasks.task("arm-regulation", arm)
    assert isinstance(one, Task)
    assert (one.name, one.arm) == ("arm-regulation", arm)


@pytest.mark.parametrize("call", [tasks.task, tasks.load])
def test_task_for_arms_without_one_lists_the_arms(call):
    with pytest.raises(BadValue, match=r"task 'arm-regulation' needs an arm; known: .*ur5e.* \(try: arm='"):
        call("arm-regulation")


def test_arm_on_the_free_body_is_refused_with_the_cure():
    for call in (tasks.task, tasks.load):
        with pytest.raises(BadValue, match=r"task 'free-body' has no arm, but 'ur5e' was named .*arm-regulation\)"):
            call("free-body", arm="ur5e")


def test_unknown_arm_lists_the_known_ones():
    with pytest.raises(UnknownName, match=r"arm 'ur6' is not in tasks/arms; known: .*ur5e"):
        tasks.task("arm-regulation", "ur6")
    with pytest.raises(UnknownName, match=r"arm 'ur6' is not in tasks/arms"):
        tasks.start_set("clear", arm="ur6")


def test_start_sets_of_arms_and_of_the_free_body_are_apart():
    with pytest.raises(UnknownName, match=r"start set 'paper' is not in tasks/arm_starts; known: clear"):
        tasks.start_set("paper", arm="ur5e")
    with pytest.raises(UnknownName, match=r"start set 'clear' is not in tasks/starts; known: box"):
        tasks.start_set("clear")
    assert tasks.start_set_title("clear", arm=True)


@pytest.mark.parametrize("count", [0, -3])
def test_count_below_one_is_refused(count):
    with pytest.raises(BadValue, match=r"count .* at least 1 \(try: count=10\)"):
        tasks.start_set("clear", count, arm="ur5e")


def test_start_without_the_joints_is_refused_with_the_cure():
    start = tasks.start_set("paper")[0]
    with pytest.raises(BadValue, match=r"q = \(\) must be 6 finite numbers on arm 'ur5e' \(try: .*'clear', arm='ur5e'"):
        tasks.load("arm-regulation", start, arm="ur5e")


def test_start_of_another_arm_is_refused():
    with pytest.raises(BadValue, match=r"must be 6 finite numbers on arm 'ur5e'"):
        tasks.load("arm-regulation", first("panda"), arm="ur5e")


@pytest.mark.parametrize("field", ["q", "qdot"])
def test_joints_that_are_not_finite_are_refused(field):
    start = first("ur5e")._replace(**{field: (0.0, 0.0, float("nan"), 0.0, 0.0, 0.0)})
    with pytest.raises(BadValue, match=rf"{field} = .*finite"):
        tasks.load("arm-regulation", start, arm="ur5e")


def test_first_start_is_the_default():
    environment = tasks.load("arm-regulation", arm="ur5e")
    assert environment.task.start == tasks.start_set("clear", 1, arm="ur5e")[0]


def test_listing_tasks_and_arms_imports_no_simulator():
    code = "import sys, tasks; tasks.names(), tasks.pairs(); print('mujoco' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"


def test_constant_of_the_domain_is_a_task_for_arms():
    from tasks.domains.arm_regulation import TASK

    assert isinstance(TASK, ArmTask)
    assert TASK.on(tasks.arm("ur5e")) is TASK.on(tasks.arm("ur5e"))


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


@on_every_arm
def test_torques_reach_the_joints_unclipped_from_the_first_tick(arm):
    """D qddot = tau - fg, thrice the rated torque included, with MuJoCo's own inverse dynamics as the oracle."""
    start, one = first(arm), tasks.arm(arm)
    tau = 3.0 * np.array(one.rated)
    environment = tasks.load("arm-regulation", start, 1e-3, integrator="rk4", arm=arm)
    environment.reset()
    physics = environment.physics
    physics.set_control(tau)
    mujoco.mj_forward(physics.model.ptr, physics.data.ptr)
    mujoco.mj_inverse(physics.model.ptr, physics.data.ptr)
    np.testing.assert_allclose(physics.data.qfrc_inverse, tau, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(physics.data.qfrc_actuator, tau, rtol=1e-14)


@on_every_arm
def test_arm_held_by_its_own_weight_stays(arm):
    """At rest tau = fg balances gravity: the joints do not move beyond rounding for a tenth of a second."""
    start = first(arm, "clear")
    environment = tasks.load("arm-regulation", start, 1e-3, arm=arm)
    environment.reset()
    for _ in range(100):
        observation = environment.step(np.array(environment.physics.data.qfrc_bias)).observation
    np.testing.assert_allclose(observation["q"], start.q, rtol=0, atol=1e-11)


@on_every_arm
def test_joint_limits_and_contacts_do_not_act(arm):
    environment = tasks.load("arm-regulation", first(arm), arm=arm)
    environment.reset()
    assert environment.physics.data.nefc == 0
    assert environment.physics.data.ncon == 0


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


# ------------------------------------------------------------------------------- an arm dropped in

DROPPED = """
import tasks
print(tasks.pairs())
for name in tasks.start_set_names(arm=True):
    print(name, len(tasks.start_set(name, 8, arm="dropped-arm")))
print(tasks.load("arm-regulation", arm="dropped-arm").reset().observation["q"].shape)
"""


def test_arm_dropped_in_has_every_start_set(tmp_path):
    shutil.copytree(Path(tasks.__file__).parent, tmp_path / "tasks", ignore=shutil.ignore_patterns("__pycache__"))
    arms = tmp_path / "tasks/arms"
    shorter = (arms / "ur5e.xml").read_text().replace(".425", ".35")
    (arms / "dropped_arm.xml").write_text(shorter)
    done = subprocess.run(
        [sys.executable, "-c", DROPPED], cwd=tmp_path, capture_output=True, text=True, check=True,
        env=os.environ | {"PYTHONPATH": str(tmp_path)},
    )  # fmt: skip
    assert "('arm-regulation', 'dropped-arm')" in done.stdout
    for name in tasks.start_set_names(arm=True):
        assert f"{name} 8" in done.stdout
    assert "(6,)" in done.stdout


def test_task_of_the_callers_own_on_an_arm_is_loaded():
    own = tasks.task("arm-regulation", "ur5e")._replace(name="own")
    environment = tasks.load(own, Start("home", *_home_pose("ur5e")))
    assert environment.task.task.name == "own"
    assert environment.reset().observation["q"].tolist() == list(tasks.arm("ur5e").home)


def _home_pose(arm):
    from tasks.kinematics import kinematics

    home = tasks.arm(arm).home
    return kinematics(tasks.arm(arm)).start("home", home, (1.0, 0.0, 0.0, 0.0))[1:]
