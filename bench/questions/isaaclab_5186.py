"""A quaternion read in the other order is another rotation, and says so nowhere."""

import numpy as np
from scipy.spatial.transform import Rotation

from bench.questions.question import Curves, Question

ANGLES_DEG, AXIS = np.linspace(0.0, 180.0, 91), np.array([0.0, 0.0, 1.0])


def curves() -> Curves:
    """Angle between the rotation that is meant and the one that is read [deg]."""
    meant = Rotation.from_rotvec(np.radians(ANGLES_DEG)[:, None] * AXIS)
    q = meant.as_quat(scalar_first=True)
    before, after = (Rotation.from_quat(q, scalar_first=first) for first in (False, True))
    return Curves(ANGLES_DEG, *(np.degrees((one.inv() * meant).magnitude()) for one in (before, after)))


QUESTION = Question(
    "isaaclab-5186",
    "(w, x, y, z) or (x, y, z, w)?",
    ("isaac-sim/IsaacLab#5186", "isaac-sim/IsaacLab#5754"),
    "A simulator changes the order of its quaternions between versions. A converter that was not changed with it "
    "corrupts every relative pose of a training set, and policies twist their arms.",
    "Four numbers of unit length are a rotation in either order: nothing fails, and the identity becomes a half turn.",
    "Name the order where a quaternion enters: scipy's scalar_first, or our check, which finds it (bench audit).",
    "angle of the rotation about z [deg]",
    "rotation read off the one that is meant [deg]",
    curves,
    tolerance=1e-6,
)
