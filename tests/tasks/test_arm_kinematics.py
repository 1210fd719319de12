"""Forward kinematics of every arm of ours against a source that is not MuJoCo's reading of our file.

The tables are typed here once more, from the makers' pages, as Denavit-Hartenberg parameters and multiplied with numpy.
"""

import math
from importlib.resources import files

import mujoco
import numpy as np
import pytest

import tasks
from tasks.kinematics import Kinematics

H = math.pi / 2

# A product of seven transforms with arms under two metres: 7 * 4 roundings of 1e-16 each; a hundredfold.
ROUNDING = 3e-13


def turn_x(angle: float) -> np.ndarray:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1]])


def turn_z(angle: float) -> np.ndarray:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])


def shift(x: float, z: float) -> np.ndarray:
    T = np.eye(4)
    T[0, 3], T[2, 3] = x, z
    return T


def standard(q, a, d, alpha) -> np.ndarray:
    """Denavit and Hartenberg: Rz(q) Tz(d) Tx(a) Rx(alpha), joint after joint."""
    T = np.eye(4)
    for i, angle in enumerate(q):
        T = T @ turn_z(angle) @ shift(a[i], d[i]) @ turn_x(alpha[i])
    return T


def modified(q, a, d, alpha) -> np.ndarray:
    """Craig: Rx(alpha) Tx(a) Rz(q) Tz(d), joint after joint."""
    T = np.eye(4)
    for i, angle in enumerate(q):
        T = T @ turn_x(alpha[i]) @ shift(a[i], 0.0) @ turn_z(angle) @ shift(0.0, d[i])
    return T


def puma560(q) -> np.ndarray:
    """Corke (1995)."""
    return standard(
        q,
        a=(0.0, 0.4318, 0.0203, 0.0, 0.0, 0.0),
        d=(0.0, 0.0, 0.15005, 0.4318, 0.0, 0.0),
        alpha=(H, 0.0, -H, H, -H, 0.0),
    )


def panda(q) -> np.ndarray:
    """Franka Control Interface, flange at .107 m, turned by -45 degrees as the hand is mounted."""
    flange = modified(
        q,
        a=(0.0, 0.0, 0.0, 0.0825, -0.0825, 0.0, 0.088),
        d=(0.333, 0.0, 0.316, 0.0, 0.384, 0.0, 0.0),
        alpha=(0.0, -H, H, H, -H, H, H),
    )
    return flange @ shift(0.0, 0.107) @ turn_z(-math.pi / 4)


MAKERS_UR5E = {"a": (0.0, -0.425, -0.3922, 0.0, 0.0, 0.0), "d": (0.1625, 0.0, 0.0, 0.1333, 0.0997, 0.0996)}
ROUNDED_UR5E = {"a": (0.0, -0.425, -0.392, 0.0, 0.0, 0.0), "d": (0.163, 0.0, 0.0, 0.134, 0.1, 0.1)}


def ur5e(q, lengths) -> np.ndarray:
    """Universal Robots, "DH parameters for calculations of kinematics and dynamics"; base turned half about z."""
    return turn_z(math.pi) @ standard(q, **lengths, alpha=(H, 0.0, 0.0, H, -H, 0.0))


def poses(arm: str, count: int = 50):
    rng = np.random.default_rng(11)
    return [rng.uniform(-math.pi, math.pi, tasks.arm(arm).joints) for _ in range(count)]


def tool(arm: str, q) -> np.ndarray:
    """MuJoCo's pose of the tool, as a 4 x 4 transform."""
    p, quat = Kinematics(tasks.arm(arm)).pose(q)
    R = np.zeros(9)
    mujoco.mju_quat2Mat(R, np.array(quat))
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R.reshape(3, 3), p
    return T


@pytest.mark.parametrize(("arm", "table"), [("puma560", puma560), ("panda", panda)])
def test_tool_pose_is_that_of_the_denavit_hartenberg_table(arm, table):
    for q in poses(arm):
        assert np.abs(tool(arm, q) - table(q)).max() <= ROUNDING


def test_ur5e_tool_pose_is_that_of_the_makers_table_in_whole_millimetres():
    for q in poses("ur5e"):
        assert np.abs(tool("ur5e", q) - ur5e(q, ROUNDED_UR5E)).max() <= ROUNDING


def test_ur5e_turns_as_the_makers_table_and_is_as_far_off_as_its_lengths():
    off = sum(
        abs(rounded - makers)
        for key in "ad"
        for rounded, makers in zip(ROUNDED_UR5E[key], MAKERS_UR5E[key], strict=True)
    )
    for q in poses("ur5e"):
        difference = tool("ur5e", q) - ur5e(q, MAKERS_UR5E)
        assert np.abs(difference[:3, :3]).max() <= ROUNDING
        assert np.linalg.norm(difference[:3, 3]) <= off < 2.2e-3


def test_jaco_is_dm_controls_own_model():
    """Its poses, inertia and gravity; theirs is compiled with its meshes, ours without."""
    path = files("dm_control") / "third_party" / "kinova" / "jaco_arm.xml"
    theirs = mujoco.MjModel.from_xml_path(str(path))
    ours = Kinematics(tasks.arm("jaco")).model
    a, b = mujoco.MjData(theirs), mujoco.MjData(ours)
    D, E = np.zeros((6, 6)), np.zeros((6, 6))
    for q in poses("jaco"):
        for model, data, M in ((theirs, a, D), (ours, b, E)):
            data.qpos[:], data.qvel[:] = q, 1.0
            mujoco.mj_forward(model, data)
            mujoco.mj_fullM(model, data, M)
        assert np.abs(a.site("wristsite").xpos - b.site("tool").xpos).max() <= ROUNDING
        assert np.abs(a.site("wristsite").xmat - b.site("tool").xmat).max() <= ROUNDING
        assert np.abs(D - E).max() <= ROUNDING * D.max()
        assert np.abs(a.qfrc_bias - b.qfrc_bias).max() <= ROUNDING * 10.0  # torques of up to 10 N m
        assert np.abs(a.qfrc_passive - b.qfrc_passive).max() <= ROUNDING
