"""MuJoCo's <orientation> actuator: what it computes, measured in MuJoCo; what the judge makes of it."""

import math

import mujoco
import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS
from support.states import directions, of_scipy, vector

import tasks
from bench.base.errors import Incompatible
from bench.experiments.plan import make
from bench.experiments.request import Request
from bench.experiments.suites import SUITES
from bench.law.contenders.registry import find_contender
from bench.law.inputs import Gains, Goal
from tasks.errors import BadValue

GAINS = Gains(kp=100.0, kv=20.0)
ONE = find_contender("in-engine")


SERVO = mujoco.MjModel.from_xml_string(tasks.task("free-body").with_servo(*GAINS).xml(1e-3))


def torque(R, R_d, omega_body):
    """The actuator's torque in the body frame, of scipy's rotations."""
    data = mujoco.MjData(SERVO)
    data.qpos[:], data.ctrl[:] = (turn.as_quat(scalar_first=True) for turn in (R, R_d))
    data.qvel[:] = omega_body
    mujoco.mj_forward(SERVO, data)
    return data.qfrc_actuator


def axes(count, seed):
    """Unit vectors: those of the base both ways, diagonals, and drawn ones."""
    directed = [*np.eye(3), *-np.eye(3), (0.6, 0.8, 0.0), (0.0, 0.6, 0.8), (1 / 3, 2 / 3, 2 / 3)]
    return [*map(np.array, directed), *directions(count, seed)]


# From a ten-thousand-millionth of a radian to as much below a half turn; 3.14159 and on are decades of what is left.
ANGLES = (1e-10, 1e-6, 1e-3, 0.1, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, *(math.pi - 10.0**-k for k in range(1, 11)))


@pytest.mark.parametrize("angle", ANGLES)
def test_torque_is_kp_times_the_rotation_vector_and_minus_kv_times_the_rate(angle):
    """scipy's logarithm beside it, and our law; all in the base frame."""
    draw = np.random.default_rng(1)
    for k in axes(20, 2):
        R_d = ScipyRotation.random(rng=draw)
        R = ScipyRotation.from_rotvec(-angle * k) * R_d
        omega = draw.normal(scale=3.0, size=3)
        found = R.apply(torque(R, R_d, R.inv().apply(omega)))
        expected = GAINS.kp * (R_d * R.inv()).as_rotvec() - GAINS.kv * omega
        ours = ONE.law(of_scipy(R), vector(omega), Goal(of_scipy(R_d)), GAINS)
        scale = GAINS.kp * math.pi + GAINS.kv * np.linalg.norm(omega)
        # some ten roundings of each quaternion and matrix
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=20 * EPS * scale)
        np.testing.assert_allclose(found, ours, rtol=0.0, atol=20 * EPS * scale)


@pytest.mark.parametrize("word", SUITES)
def test_suite_runs_it_in_mujoco_alone_on_sampled_starts_and_half_turns(word):
    units = make(Request(word, (ONE,))).of("free-body", "arm", "robustness")
    assert {unit.engine for unit in units} <= {"native", "reference"}
    assert {"uniform", "half-turn", "paper", "poles"} <= {unit.selector for unit in units}
    assert {unit.arm for unit in units} == {""}


def test_it_is_refused_where_mujoco_has_no_such_actuator():
    for choice, reason in (
        ({"tasks": ("free-body",), "engines": ("ideal-rk4",)}, "ideal-rk4 simulates no actuator of MuJoCo"),
        ({"arms": ("ur5e",)}, "'in-engine' is an actuator of MuJoCo and turns the free body alone"),
    ):
        with pytest.raises(Incompatible, match=reason):
            make(Request("quick", (ONE,), **choice))
    with pytest.raises(BadValue, match="'arm-regulation' has no model with an <orientation> actuator"):
        tasks.task("arm-regulation", "ur5e").with_servo(*GAINS)
