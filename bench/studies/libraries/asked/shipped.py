"""Controllers that cannot be installed here: the orientation error that their source states, written anew.

Each is read at the commit beside it. Their damping is 2 sqrt(stiffness) as delivered (serl's, 7 at 150, apart), which
at kp = 100 is the suite's kv = 20; what differs is the error. A clip per axis is along the axes of the base.
"""

import math

import numpy as np

from bench.studies.libraries.library import QUATERNION, Function, Library

DEADBAND = 5e-3
SERL_CLIP_RAD, CRISP_CLIP_RAD, FZI_NORM_RAD = 0.05, 0.5, 1.0


def shorter(quat_wxyz) -> np.ndarray:
    """The quaternion whose scalar is not negative, of the two for a rotation."""
    return -quat_wxyz if quat_wxyz[0] < 0.0 else quat_wxyz


def vector_part(quat_wxyz) -> np.ndarray:
    """sin(theta/2) k, the shorter way round, without the factor 2."""
    return shorter(quat_wxyz)[1:]


def with_deadband(quat_wxyz) -> np.ndarray:
    """The vector part, each component nought within DEADBAND."""
    e = vector_part(quat_wxyz)
    return np.where(np.abs(e) < DEADBAND, 0.0, e)


def clipped_vector_part(quat_wxyz) -> np.ndarray:
    """The vector part, each component held within SERL_CLIP_RAD."""
    return np.clip(vector_part(quat_wxyz), -SERL_CLIP_RAD, SERL_CLIP_RAD)


def times_sign(quat_wxyz) -> np.ndarray:
    """The vector part times the sign of the scalar, which is nought at nought."""
    return quat_wxyz[1:] * np.sign(quat_wxyz[0])


def rotation_vector(quat_wxyz) -> np.ndarray:
    """theta k."""
    q = shorter(quat_wxyz)
    length = math.hypot(*q[1:])
    return q[1:] * (2.0 * math.atan2(length, q[0]) / length if length else 2.0)


def clipped_logarithm(quat_wxyz) -> np.ndarray:
    """theta k, each component held within CRISP_CLIP_RAD."""
    return np.clip(rotation_vector(quat_wxyz), -CRISP_CLIP_RAD, CRISP_CLIP_RAD)


def bounded_logarithm(quat_wxyz) -> np.ndarray:
    """theta k, at most FZI_NORM_RAD long."""
    e = rotation_vector(quat_wxyz)
    return e * min(1.0, FZI_NORM_RAD / max(math.hypot(*e), 1e-300))


def restated(name: str, source: str, call) -> Library:
    """A controller by its repository and the commit that was read."""
    return Library(name, source, (Function("orientation error", QUATERNION, call),), is_restated=True)


LIBRARIES = (
    restated("franka_ros", "frankaemika/franka_ros@8d16d343", vector_part),
    restated("deoxys_control", "UT-Austin-RPL/deoxys_control@49e63283", with_deadband),
    restated("serl_franka_controllers", "rail-berkeley/serl_franka_controllers@5576ce17", clipped_vector_part),
    restated("Isaac Gym idiom", "isaacgym/python/examples/franka_cube_ik_osc.py@Preview 4", times_sign),
    restated("crisp_controllers", "utiasDSL/crisp_controllers@2b33ab77", clipped_logarithm),
    restated(
        "cartesian_controllers", "fzi-forschungszentrum-informatik/cartesian_controllers@017b68d6", bounded_logarithm
    ),
)
