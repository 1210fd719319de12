"""An angle by arc cosine has half of the digits near the goal, and inverse kinematics do not converge."""

import numpy as np
from scipy.spatial.transform import Rotation

from bench.questions.question import Curves, Question

AXIS = np.array([1.0, 2.0, 3.0]) / np.sqrt(14.0)
ANGLES = np.geomspace(1e-10, 1e-2, 80)


def curves() -> Curves:
    """Error of the angle of a rotation matrix, over the angle."""
    R = Rotation.from_rotvec(ANGLES[:, None] * AXIS).as_matrix()
    c = 0.5 * (np.trace(R, axis1=1, axis2=2) - 1.0)
    v = 0.5 * np.stack((R[:, 2, 1] - R[:, 1, 2], R[:, 0, 2] - R[:, 2, 0], R[:, 1, 0] - R[:, 0, 1]), axis=1)
    by_cosine, by_both = np.arccos(np.clip(c, -1.0, 1.0)), np.arctan2(np.linalg.norm(v, axis=1), c)
    return Curves(ANGLES, np.abs(by_cosine / ANGLES - 1.0), np.abs(by_both / ANGLES - 1.0))


QUESTION = Question(
    "kdl-109",
    "Inverse kinematics fail to converge to a millionth",
    tuple(f"orocos/orocos_kinematics_dynamics#{number}" for number in (199, 109, 139)),
    "With an angle by arc cosine, inverse kinematics to 1e-6 or 1e-7 fail often; with atan2 they succeed. Near "
    "180° the axis of the same function was another rotation's.",
    "Near 0 the cosine is flat: a last bit of the trace is 1e-8 rad, all of a small angle.",
    "θ = atan2(|v|, c) with v from R − Rᵀ and c from the trace; near 180° by a quaternion.",
    "angle [rad]",
    "relative error of the angle",
    curves,
    tolerance=1e-6,
    is_log_x=True,
    is_log_y=True,
)
