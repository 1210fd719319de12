"""A difference of Euler angles with the geometric Jacobian commands another axis."""

import numpy as np
from scipy.spatial.transform import Rotation

from bench.questions.question import Curves, Question

BETA_DEG, SMALL = np.linspace(0.0, 85.0, 60), 1e-4
ALPHA, GAMMA = 0.4, 0.3
DIFFERENCE = SMALL * np.array([1.0, 0.0, 1.0])


def off(command: np.ndarray, needed: np.ndarray) -> float:
    """Angle between two vectors [deg]."""
    return float(np.degrees(np.arctan2(np.linalg.norm(np.cross(command, needed)), command @ needed)))


def curves() -> Curves:
    """Angle between the commanded axis and the one that leads to the goal."""
    before, after = [], []
    for beta in np.radians(BETA_DEG):
        E = np.array([ALPHA, beta, GAMMA])
        R, R_d = (Rotation.from_euler("ZYX", angles) for angles in (E, E + DIFFERENCE))
        needed = (R_d * R.inv()).as_rotvec()
        s_a, c_a, s_b, c_b = np.sin(ALPHA), np.cos(ALPHA), np.sin(beta), np.cos(beta)
        B = np.array([[0.0, -s_a, c_a * c_b], [0.0, c_a, s_a * c_b], [1.0, 0.0, -s_b]])
        before.append(off(DIFFERENCE, needed))
        after.append(off(B @ DIFFERENCE, needed))
    return Curves(BETA_DEG, np.array(before), np.array(after))


QUESTION = Question(
    "control-toolbox-190",
    "Which Jacobian goes with which error?",
    ("ethz-adrl/control-toolbox#190", "google-deepmind/mujoco#89", "jrl-umi3218/RBDyn#84"),
    "Three users ask whether the Jacobian that their library gives is the geometric or the analytical one, "
    "whether it fits their error of orientation, and why orientation control fails where position works.",
    "The geometric Jacobian's lower rows are ω. A difference of Euler angles is none: ω = B(E) Ė.",
    "With the geometric Jacobian an error that is a vector in the base frame: the logarithm, or B times the "
    "difference.",
    "β [deg], Z-Y-X angles",
    "commanded axis off the one that leads to the goal [deg]",
    curves,
    tolerance=0.1,
)
