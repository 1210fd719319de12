"""robosuite: the error of its operational-space controller, and its law with its own gains.

Its requirements contradict those of the other libraries, so it is asked in an environment of its own.
"""

import math
from functools import partial

import numpy as np
from robosuite.utils import transform_utils
from robosuite.utils.control_utils import orientation_error

from bench.studies.libraries.free_body import accelerated
from bench.studies.libraries.library import MATRIX, QUATERNION, Controller, Function, Library

KP, KV, DT_S = 150.0, 2.0 * math.sqrt(150.0), 0.002
"""OSC_POSE as delivered: kp 150, damping_ratio 1, control at the simulation's 500 Hz."""


def axis_angle(quat_wxyz) -> np.ndarray:
    """quat2axisangle, which takes (x, y, z, w)."""
    return transform_utils.quat2axisangle(quat_wxyz[[1, 2, 3, 0]])


def matrix_to_axis_angle(R) -> np.ndarray:
    """mat2quat, then quat2axisangle."""
    return transform_utils.quat2axisangle(transform_utils.mat2quat(R))


ERROR = Function("orientation_error", MATRIX, lambda R: orientation_error(R, np.eye(3)), "sine")
OSC = Controller(
    "OSC_POSE, rotation decoupled",
    ERROR.name,
    "acceleration",
    "kp 150, damping ratio 1, 500 Hz",
    DT_S,
    partial(accelerated, ERROR, KP, KV, DT_S),
)
LIBRARY = Library(
    "robosuite",
    "robosuite",
    (
        ERROR,
        Function("quat2axisangle", QUATERNION, axis_angle),
        Function("mat2quat, quat2axisangle", MATRIX, matrix_to_axis_angle),
    ),
    (OSC,),
)
