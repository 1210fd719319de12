"""What every arm of tasks/arms keeps to; a new file is tested with no change here."""

import math
import xml.etree.ElementTree as ElementTree

import mujoco
import numpy as np
import pytest
from support.buffers import inertia_of, jacobian_of, state_of

import tasks
from tasks.arm import WORD
from tasks.arm_model import model_xml
from tasks.kinematics import Kinematics
from tasks.sensors import SENSORS

DT = 1e-3


@pytest.fixture(params=tasks.arm_names())
def arm(request):
    return tasks.arm(request.param)


@pytest.fixture
def model(arm):
    return mujoco.MjModel.from_xml_string(model_xml(arm, DT))


def written(arm) -> ElementTree.Element:
    return ElementTree.fromstring(arm.xml)


def poses(arm, count=100):
    return np.random.default_rng(3).uniform(-math.pi, math.pi, (count, arm.joints))


def test_file_has_a_word_a_short_title_and_a_source_and_no_meshes(arm):
    assert WORD.fullmatch(arm.name)
    assert len(arm.title) <= 60
    assert len(arm.source) > 20
    assert not list(written(arm).iter("mesh"))


def test_home_is_the_keyframe_of_the_file(arm):
    key = written(arm).find("./keyframe/key[@name='home']")
    assert arm.home == tuple(map(float, key.get("qpos").split()))
    assert arm.pose("home") == arm.home


def test_rated_torques_are_the_motors_ranges(arm):
    motors = written(arm).findall("./actuator/motor")
    assert arm.rated == tuple(float(motor.get("ctrlrange").split()[1]) for motor in motors)
    assert min(arm.rated) > 0.0


def test_joint_ranges_are_those_of_the_model_and_home_is_inside(arm, model):
    for i in range(arm.joints):
        limits = tuple(model.jnt_range[i]) if model.jnt_limited[i] else (-math.inf, math.inf)
        assert (arm.lower[i], arm.upper[i]) == limits
        assert arm.lower[i] < arm.home[i] < arm.upper[i]


def test_home_is_well_conditioned_far_from_the_pole_and_held_with_half_the_motors_torque(arm, model):
    """In metres and radians a stretched or folded arm is near from 20 on; |cos beta| is above a half."""
    assert Kinematics(arm).condition(arm.home) < 20.0
    _, (w, x, y, z) = Kinematics(arm).pose(arm.home)
    assert abs(2.0 * (w * y - z * x)) < math.sqrt(3.0) / 2.0
    assert np.all(np.abs(state_of(model, arm.home).qfrc_bias) <= 0.5 * np.array(arm.rated))


def test_sensors_are_those_of_the_judge_in_order(arm, model):
    names = [model.sensor(i).name for i in range(model.nsensor)]
    assert names == [*(name for name, _, _ in SENSORS), "p"]
    data = state_of(model, arm.home, 0.3)
    R = data.site("tool").xmat.reshape(3, 3)
    assert np.array_equal(data.sensordata[0:9], R.T.ravel())
    assert data.sensordata[9:12] == pytest.approx((jacobian_of(model, data, "tool") @ data.qvel)[3:], abs=1e-14)
    turned = np.zeros(9)
    mujoco.mju_quat2Mat(turned, data.sensordata[12:16])
    assert turned.reshape(3, 3) == pytest.approx(R, abs=1e-14)
    assert np.array_equal(data.sensordata[16:19], data.site("tool").xpos)


def test_inertia_matrix_is_positive_definite_everywhere(arm, model):
    for q in poses(arm):
        D = inertia_of(model, state_of(model, q))
        assert np.array_equal(D, D.T)
        spectrum = np.linalg.eigvalsh(D)
        assert spectrum[0] > 1e-8 * spectrum[-1]


def test_every_links_inertia_is_one_a_body_can_have(arm, model):
    """Positive, and no principal moment above the sum of the other two (but for the rounding of the sum)."""
    for body in {int(model.jnt_bodyid[i]) for i in range(model.njnt)}:
        small, middle, large = sorted(model.body_inertia[body])
        assert model.body_mass[body] > 0.0
        assert small > 0.0
        assert large <= (small + middle) * (1.0 + 1e-15)


def test_nothing_else_acts_on_the_arm(arm, model):
    """Accelerations are those of D qddot = tau - fg, fast and far from home, and what is passive damps alone."""
    rng = np.random.default_rng(4)
    for q in poses(arm, 20):
        data = state_of(model, q, rng.uniform(-3, 3, arm.joints))
        data.ctrl[:] = rng.uniform(-2, 2, arm.joints) * arm.rated  # beyond the rated torque: nothing clips
        mujoco.mj_forward(model, data)
        D = inertia_of(model, data)
        np.testing.assert_allclose(data.qfrc_passive, -model.dof_damping * data.qvel, rtol=1e-14)
        residual = D @ data.qacc - (data.ctrl - data.qfrc_bias + data.qfrc_passive)
        assert np.abs(residual).max() <= 1e-12 * (np.abs(D) @ np.abs(data.qacc)).max()
