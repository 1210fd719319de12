"""A tolerance about three axes: angles about axes, or a rotation vector?"""

import numpy as np
from scipy.spatial.transform import Rotation

from bench.questions.question import Curves, Question

YAW_DEG, TILT = np.linspace(0.0, 179.0, 90), np.radians(3.0)


def curves() -> Curves:
    """What the first two numbers make of a tilt, over the tilt, while the third is free."""
    before, after = [], []
    for yaw in np.radians(YAW_DEG):
        R = Rotation.from_rotvec([TILT, 0.0, 0.0]) * Rotation.from_rotvec([0.0, 0.0, yaw])
        before.append(np.linalg.norm(R.as_rotvec()[:2]) / TILT)
        after.append(np.linalg.norm(R.as_euler("XYZ")[:2]) / TILT)
    return Curves(YAW_DEG, np.array(before), np.array(after))


QUESTION = Question(
    "moveit-msgs-82",
    "A tolerance box of which numbers?",
    ("moveit/moveit_msgs#82", "moveit/moveit_msgs#89", "moveit/moveit_msgs#96"),
    "A message says that its three tolerances are of axis and angle; the code that checks it takes roll, pitch "
    "and yaw, and another planner takes a rotation vector.",
    "Far from zero they are other numbers. While a tool turns freely about z, the first two components of the rotation "
    "vector grow to π/2 times the tilt that they are meant to bound.",
    "Say which: for a free turn about z the angles X-Y-Z, whose first two are the tilt, or the angle of the z "
    "axis itself.",
    "free turn about z [deg]",
    "first two numbers over the tilt",
    curves,
    right=1.0,
    tolerance=0.01,
)
