"""Kinematics and dynamics of every arm of ours against a source that is not MuJoCo's reading of our file.

The tables are typed here once more, from the makers' pages, as Denavit-Hartenberg parameters and multiplied with numpy.
The PUMA's published numbers are the Robotics Toolbox's, with reflected motor inertia. The one departure, link 3's
inertia clipped by .0075 kg m^2 about the axes of joints 2 and 3 (see puma560.xml), is subtracted here.
"""

import functools
import math
from importlib.resources import files

import mujoco
import numpy as np
import pinocchio
import pytest
from scipy.spatial.transform import Rotation
from support.buffers import inertia_of, state_of

import tasks
from tasks.kinematics import Kinematics

H = math.pi / 2

# A product of seven transforms with arms under two metres: 7 * 4 roundings of 1e-16 each; a hundredfold.
ROUNDING = 3e-13


def frame(axis: str, angle: float, x=0.0, z=0.0) -> np.ndarray:
    """A turn about an axis at a place, as a 4 x 4 transform."""
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = Rotation.from_euler(axis, angle).as_matrix(), (x, 0.0, z)
    return T


def chain(transforms) -> np.ndarray:
    return functools.reduce(np.matmul, transforms)


def standard(q, a, d, alpha) -> np.ndarray:
    """Denavit and Hartenberg: Rz(q) Tz(d) Tx(a) Rx(alpha), joint after joint."""
    return chain(frame("z", angle) @ frame("x", alpha[i], a[i], d[i]) for i, angle in enumerate(q))


def modified(q, a, d, alpha) -> np.ndarray:
    """Craig: Rx(alpha) Tx(a) Rz(q) Tz(d), joint after joint."""
    return chain(frame("x", alpha[i], a[i]) @ frame("z", angle, z=d[i]) for i, angle in enumerate(q))


# Corke (1995).
PUMA = {
    "a": (0.0, 0.4318, 0.0203, 0.0, 0.0, 0.0),
    "d": (0.0, 0.0, 0.15005, 0.4318, 0.0, 0.0),
    "alpha": (H, 0.0, -H, H, -H, 0.0),
}
# Franka Control Interface, flange at .107 m, turned by -45 degrees as the hand is mounted.
PANDA = {
    "a": (0.0, 0.0, 0.0, 0.0825, -0.0825, 0.0, 0.088),
    "d": (0.333, 0.0, 0.316, 0.0, 0.384, 0.0, 0.0),
    "alpha": (0.0, -H, H, H, -H, H, H),
}
# Universal Robots, "DH parameters for calculations of kinematics and dynamics"; base turned half about z.
UR5E = {
    "a": (0.0, -0.425, -0.3922, 0.0, 0.0, 0.0),
    "d": (0.1625, 0.0, 0.0, 0.1333, 0.0997, 0.0996),
    "alpha": (H, 0.0, 0.0, H, -H, 0.0),
}
TOOLS = {
    "puma560": lambda q: standard(q, **PUMA),
    "panda": lambda q: modified(q, **PANDA) @ frame("z", -math.pi / 4, z=0.107),
    "ur5e": lambda q: frame("z", math.pi) @ standard(q, **UR5E),
}


def poses(arm: str, count: int = 50):
    rng = np.random.default_rng(11)
    return [rng.uniform(-math.pi, math.pi, tasks.arm(arm).joints) for _ in range(count)]


@pytest.mark.parametrize("arm", TOOLS)
def test_tool_pose_is_that_of_the_denavit_hartenberg_table(arm):
    for q in poses(arm):
        p, quat = Kinematics(tasks.arm(arm)).pose(q)
        T = TOOLS[arm](q)
        assert np.abs(T[:3, :3] - Rotation.from_quat(quat, scalar_first=True).as_matrix()).max() <= ROUNDING
        assert np.abs(T[:3, 3] - p).max() <= ROUNDING


# The maker's page: masses, and centres of mass in the frames of its table. Its ROS 2 description at 3426d67: inertias
# about them, (xx, yy, zz, xy, xz, yz) in the same frames. roboticstoolbox's UR5e at 6f5b003 has these masses too.
MASSES = (3.761, 8.058, 2.846, 1.37, 1.3, 0.365)
CENTRES = (
    (0.0, -0.02561, 0.00193),
    (0.2125, 0.0, 0.11336),
    (0.15, 0.0, 0.0265),
    (0.0, -0.0018, 0.01634),
    (0.0, 0.0018, 0.01634),
    (0.0, 0.0, -0.001159),
)
INERTIAS = (
    (7.0021e-3, 6.48091e-3, 6.57286e-3, 7.3e-7, -1.053e-5, 4.9994e-4),
    (1.505885e-2, 0.33388086, 0.33247207, -5.4e-5, 5.63e-6, -1.81e-6),
    (3.99632e-3, 7.879254e-2, 7.84851e-2, -1.365e-5, 1.37272e-3, -6.6e-6),
    (1.65491e-3, 1.35962e-3, 1.26279e-3, -2.82e-6, -4.38e-6, 1.0157e-4),
    (1.35617e-3, 1.27827e-3, 9.6614e-4, -2.74e-6, 4.44e-6, -5.048e-5),
    (1.8694e-4, 1.8908e-4, 2.5756e-4, 6e-8, -1.7e-7, -9.2e-7),
)


def pinocchios_ur5e() -> pinocchio.Model:
    """The arm from the maker's two tables alone: joint i turns about z of frame i - 1, and carries what follows it."""
    model, before = pinocchio.Model(), pinocchio.SE3(frame("z", math.pi))
    for i in range(6):
        joint = model.addJoint(i, pinocchio.JointModelRZ(), before, f"joint {i + 1}")
        before = pinocchio.SE3(frame("x", UR5E["alpha"][i], UR5E["a"][i], UR5E["d"][i]))
        xx, yy, zz, xy, xz, yz = INERTIAS[i]
        inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        model.appendBodyToJoint(joint, pinocchio.Inertia(MASSES[i], np.array(CENTRES[i]), inertia), before)
    return model


def test_ur5e_weighs_and_swings_as_pinocchio_says_from_the_makers_tables():
    """fg at rest and in motion, and D less the motors', at 100 poses; at rest no joint takes half its rated torque."""
    theirs, ours = pinocchios_ur5e(), Kinematics(tasks.arm("ur5e")).model
    known = theirs.createData()
    for q in poses("ur5e", 100):
        for rates in (np.zeros(6), np.linspace(-2.0, 3.0, 6)):
            data = state_of(ours, q, rates)
            expected = pinocchio.nonLinearEffects(theirs, known, q, rates)
            assert np.abs(data.qfrc_bias - expected).max() <= ROUNDING * 100.0  # torques of up to 100 N m
            assert rates.any() or (np.abs(expected) < 0.5 * np.array(tasks.arm("ur5e").rated)).all()
        D, expected = inertia_of(ours, data), pinocchio.crba(theirs, known, q)
        expected = np.triu(expected) + np.triu(expected, 1).T
        assert np.abs(D - np.diag(ours.dof_armature) - expected).max() <= ROUNDING * D.max()


def test_jaco_is_dm_controls_own_model():
    """Its poses, inertia and gravity; theirs is compiled with its meshes, ours without."""
    path = files("dm_control") / "third_party" / "kinova" / "jaco_arm.xml"
    theirs = mujoco.MjModel.from_xml_path(str(path))
    ours = Kinematics(tasks.arm("jaco")).model
    for q in poses("jaco"):
        a, b = (state_of(model, q, 1.0) for model in (theirs, ours))
        D, E = inertia_of(theirs, a), inertia_of(ours, b)
        assert np.abs(a.site("wristsite").xpos - b.site("tool").xpos).max() <= ROUNDING
        assert np.abs(a.site("wristsite").xmat - b.site("tool").xmat).max() <= ROUNDING
        assert np.abs(D - E).max() <= ROUNDING * D.max()
        assert np.abs(a.qfrc_bias - b.qfrc_bias).max() <= ROUNDING * 10.0  # torques of up to 10 N m
        assert np.abs(a.qfrc_passive - b.qfrc_passive).max() <= ROUNDING


CLIPPED = 0.086 - 0.0785
NOMINAL = (0.0, math.pi / 4, math.pi, 0.0, math.pi / 4, 0.0)


def test_inertia_and_gravity_of_the_puma_at_the_nominal_and_the_zero_pose_are_the_published_ones():
    """To the last digits of the tables."""
    assert tasks.arm("puma560").pose("qn") == NOMINAL
    published, puma = np.array([3.6594, 4.4137, 0.9378, 0.1925, 0.1713, 0.1941]), Kinematics(tasks.arm("puma560"))
    clipped = np.array([0.0, CLIPPED, CLIPPED, 0.0, 0.0, 0.0])
    assert np.abs(np.diag(puma.inertia_matrix(NOMINAL)) - (published - clipped)).max() <= 0.5e-4 + 1e-12
    for q, published in ((NOMINAL, [0.0, 31.640, 6.035, 0.0, 0.0283, 0.0]), ((0.0,) * 6, [0, 37.484, 0.249, 0, 0, 0])):
        assert state_of(puma.model, q).qfrc_bias == pytest.approx(published, abs=5e-4)
