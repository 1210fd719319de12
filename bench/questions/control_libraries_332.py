"""The vector part of a quaternion as the error: half the stiffness, and of the other sign from half of all readings."""

import numpy as np

from bench.questions.question import Curves, Question

ANGLES_DEG = np.linspace(1.0, 179.0, 90)


def curves() -> Curves:
    """Torque along the axis over K times the angle, from the sign of q that a stream may have at any time."""
    half = 0.5 * np.radians(ANGLES_DEG)
    sign = np.where(np.arange(len(half)) % 2 == 0, 1.0, -1.0)
    w, v = sign * np.cos(half), sign * np.sin(half)
    near = np.where(w < 0.0, -1.0, 1.0)
    right = 2.0 * np.arctan2(near * v, near * w)
    return Curves(ANGLES_DEG, v / (2.0 * half), right / (2.0 * half))


QUESTION = Question(
    "control-libraries-332",
    "Vector part or rotation vector? Torques flip",
    (
        "epfl-lasa/control-libraries#332",
        "aica-technology/control-libraries#116",
        "aica-technology/control-libraries#117",
    ),
    "An impedance controller uses the quaternion's vector part for the angle; rotational stiffness is not what is"
    " set, and after a change of how quaternions are handled the torque's direction flips around certain poses.",
    "The vector part is sin(θ/2) k: half of the angle near the goal. Its sign is the quaternion's, and q and −q "
    "are one orientation.",
    "Negate q if w < 0, then 2 atan2(|v|, w) v/|v|, or 2 v if half of the angle's growth far out is wanted.",
    "angle to the goal [deg], neighbours of either sign",
    "torque over K times the angle",
    curves,
    right=1.0,
    tolerance=0.05,
)
