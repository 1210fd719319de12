"""Drake: pydrake.math and its binding of Eigen's AngleAxis."""

import numpy as np
from pydrake.common.eigen_geometry import AngleAxis, Quaternion
from pydrake.math import RollPitchYaw, RotationMatrix

from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library


def vector(found: AngleAxis) -> np.ndarray:
    """Angle times axis."""
    return found.angle() * found.axis()


def unit(quat_wxyz) -> Quaternion:
    """Normalized again: Drake refuses what is not of length 1 to 1e-14."""
    return Quaternion(quat_wxyz / np.linalg.norm(quat_wxyz))


LIBRARY = Library(
    "drake",
    "drake",
    (
        Function("RotationMatrix.ToAngleAxis", MATRIX, lambda R: vector(RotationMatrix(R).ToAngleAxis())),
        Function("AngleAxis, of a quaternion", QUATERNION, lambda q: vector(AngleAxis(unit(q)))),
        Function(
            "2 RotationMatrix.ToQuaternion, vector part",
            MATRIX,
            lambda R: 2.0 * RotationMatrix(R).ToQuaternion().xyz(),
            "sine-of-half",
        ),
        Function("RollPitchYaw", MATRIX, lambda R: RollPitchYaw(RotationMatrix(R)).vector(), "z-y-x"),
    ),
)
