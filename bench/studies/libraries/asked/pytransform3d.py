"""pytransform3d: pytransform3d.rotations."""

import numpy as np
from pytransform3d import rotations

from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library


def of_matrix(R) -> np.ndarray:
    """axis_angle_from_matrix as one vector."""
    found = rotations.axis_angle_from_matrix(R)
    return found[3] * found[:3]


LIBRARY = Library(
    "pytransform3d",
    "pytransform3d",
    (
        Function("axis_angle_from_matrix", MATRIX, of_matrix, thread="dfki-ric/pytransform3d#43"),
        Function("compact_axis_angle_from_quaternion", QUATERNION, rotations.compact_axis_angle_from_quaternion),
        Function("4 mrp_from_quaternion", QUATERNION, lambda q: 4.0 * rotations.mrp_from_quaternion(q), "mrp"),
    ),
)
