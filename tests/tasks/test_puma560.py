"""The PUMA against the Robotics Toolbox's published numbers.

They are for the standard table with reflected motor inertia. The one departure, link 3's inertia clipped by .0075
kg m^2 about the axes of joints 2 and 3 (see puma560.xml), is subtracted here; gravity does not know of it.
"""

import math

import mujoco
import numpy as np
import pytest

import tasks
from tasks.kinematics import Kinematics

CLIPPED = 0.086 - 0.0785
NOMINAL = (0.0, math.pi / 4, math.pi, 0.0, math.pi / 4, 0.0)


def dynamics(q) -> tuple[np.ndarray, np.ndarray]:
    """D and the torque that holds the arm there."""
    model = Kinematics(tasks.arm("puma560")).model
    data = mujoco.MjData(model)
    data.qpos[:] = q
    mujoco.mj_forward(model, data)
    D = np.zeros((6, 6))
    mujoco.mj_fullM(model, data, D)
    return D, np.array(data.qfrc_bias)


def test_nominal_pose_is_the_toolboxs():
    assert tasks.arm("puma560").pose("qn") == pytest.approx(NOMINAL, abs=0.0)


def test_inertia_at_the_nominal_pose_is_the_published_one():
    published = np.array([3.6594, 4.4137, 0.9378, 0.1925, 0.1713, 0.1941])
    clipped = np.array([0.0, CLIPPED, CLIPPED, 0.0, 0.0, 0.0])
    D, _ = dynamics(NOMINAL)
    assert np.abs(np.diag(D) - (published - clipped)).max() <= 0.5e-4 + 1e-12  # the table's last digit


def test_gravity_at_the_nominal_and_the_zero_pose_is_the_published_one():
    for q, published in ((NOMINAL, [0.0, 31.640, 6.035, 0.0, 0.0283, 0.0]), ((0.0,) * 6, [0, 37.484, 0.249, 0, 0, 0])):
        assert dynamics(q)[1] == pytest.approx(published, abs=5e-4)  # the table's last digit


def test_nominal_pose_is_on_the_pole_while_the_arm_is_well_conditioned():
    kinematics = Kinematics(tasks.arm("puma560"))
    _, (w, x, y, z) = kinematics.pose(NOMINAL)
    # The toolbox's pi and pi/4 are doubles, so sin beta is 1 to rounding.
    assert abs(2.0 * (w * y - z * x)) == pytest.approx(1.0, abs=1e-12)
    assert kinematics.condition(NOMINAL) == pytest.approx(7.9, abs=0.05)
