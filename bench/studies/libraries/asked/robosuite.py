"""robosuite: the error of its operational-space controller.

Its requirements contradict those of the other libraries, so it is asked in an environment of its own.
"""

import numpy as np
from robosuite.utils import transform_utils
from robosuite.utils.control_utils import orientation_error

from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library


def axis_angle(quat_wxyz) -> np.ndarray:
    """quat2axisangle, which takes (x, y, z, w)."""
    return transform_utils.quat2axisangle(quat_wxyz[[1, 2, 3, 0]])


def matrix_to_axis_angle(R) -> np.ndarray:
    """mat2quat, then quat2axisangle."""
    return transform_utils.quat2axisangle(transform_utils.mat2quat(R))


LIBRARY = Library(
    "robosuite",
    "robosuite",
    (
        Function("orientation_error", MATRIX, lambda R: orientation_error(R, np.eye(3)), "sine"),
        Function("quat2axisangle", QUATERNION, axis_angle),
        Function("mat2quat, quat2axisangle", MATRIX, matrix_to_axis_angle),
    ),
)
