"""One masked rotational axis still steers the other two."""

import numpy as np
from scipy.spatial.transform import Rotation

from bench.questions.question import Curves, Question

YAW_DEG, TILT = np.linspace(0.0, 175.0, 60), np.radians(5.0)
TILT_AXIS = np.array([1.0, 0.0, 0.0])


def off(command: np.ndarray, needed: np.ndarray) -> float:
    """Angle between two vectors of the tool's plane [deg]."""
    return float(np.degrees(np.arctan2(np.linalg.norm(np.cross(command, needed)), command @ needed)))


def curves() -> Curves:
    """Angle between the command about the tool's x and y and the one that takes its z axis to the goal's."""
    before, after = [], []
    for yaw in np.radians(YAW_DEG):
        wanted = Rotation.from_rotvec(TILT * TILT_AXIS) * Rotation.from_rotvec(yaw * np.array([0.0, 0.0, 1.0]))
        z, z_d = np.array([0.0, 0.0, 1.0]), wanted.as_matrix()[:, 2]
        shortest, _ = Rotation.align_vectors([z_d], [z])
        before.append(off(wanted.as_rotvec() * np.array([1.0, 1.0, 0.0]), shortest.as_rotvec()))
        after.append(off(np.cross(z, z_d), shortest.as_rotvec()))
    return Curves(YAW_DEG, np.array(before), np.array(after))


QUESTION = Question(
    "tsid-118",
    "A masked axis disturbs the others",
    ("stack-of-tasks/tsid#118", "gbionics/bipedal-locomotion-framework#356"),
    "With some axes masked, references of these that are far off still change the motion, or the solver finds "
    "none. Elsewhere reviewers ask what a mask on one rotational axis means at all.",
    "The error is the logarithm of the whole rotation, of which one component is then struck out. Its other "
    "components are turned by half of the angle about the masked axis.",
    "An error of two degrees of freedom, z × z_d: it knows nothing of the turn about z.",
    "turn about the masked axis [deg]",
    "command off the shortest way of the tool's axis [deg]",
    curves,
    tolerance=1.0,
)
