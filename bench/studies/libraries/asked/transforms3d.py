"""transforms3d: axis and angle of matrices and quaternions, and the angles of ROS's conversions."""

import numpy as np
from transforms3d import axangles, euler, quaternions

from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library


def vector(found) -> np.ndarray:
    """Angle times axis."""
    axis, angle = found
    return angle * np.asarray(axis)


LIBRARY = Library(
    "transforms3d",
    "transforms3d",
    (
        Function("mat2axangle", MATRIX, lambda R: vector(axangles.mat2axangle(R))),
        Function("quat2axangle", QUATERNION, lambda q: vector(quaternions.quat2axangle(q))),
        Function("mat2quat, quat2axangle", MATRIX, lambda R: vector(quaternions.quat2axangle(quaternions.mat2quat(R)))),
        Function("mat2euler", MATRIX, lambda R: np.array(euler.mat2euler(R, "sxyz")), "z-y-x"),
    ),
)
