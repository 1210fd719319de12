"""A stiffness of three numbers: about the axes of which frame?"""

import numpy as np
from scipy.spatial.transform import Rotation

from bench.questions.question import Curves, Question

TURN_DEG = np.linspace(0.0, 90.0, 60)
K = np.diag([100.0, 10.0, 10.0])
ERROR = 0.1 * np.array([0.0, 1.0, 1.0]) / np.sqrt(2.0)


def curves() -> Curves:
    """Angle between the torque and that of the spring that was meant, along axes of the control frame."""
    before: list[float] = []
    after: list[float] = []
    for turn in np.radians(TURN_DEG):
        R = Rotation.from_rotvec([0.0, turn, 0.0]).as_matrix()
        error = R @ ERROR  # the same in the control frame, whatever its turn
        meant = R @ (K @ ERROR)
        for made, torque in ((before, K @ error), (after, R @ K @ R.T @ error)):
            made.append(np.degrees(np.arctan2(np.linalg.norm(np.cross(torque, meant)), torque @ meant)))
    return Curves(TURN_DEG, np.array(before), np.array(after))


QUESTION = Question(
    "ros2-controllers-1178",
    "Stiffness in which frame?",
    ("ros-controls/ros2_controllers#1178", "ros-controls/ros2_controllers#1139"),
    "A contributor asks why an admittance rule is computed in the base frame, and which frame its stiffness, "
    "damping and mass are about; a change applies the control frame's rotation to the mass as well.",
    "Three numbers on a diagonal are a matrix in one frame. Used in another they are other springs: the tool pushes "
    "about an axis that nobody set.",
    "Rotate the matrix, not the vector alone: K_base = R K Rᵀ, of mass, damping and stiffness alike.",
    "turn of the control frame [deg]",
    "torque off the one that was meant [deg]",
    curves,
    tolerance=1e-6,
)
