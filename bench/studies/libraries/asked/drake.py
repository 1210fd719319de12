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
        Function(
            "RotationMatrix.ToAngleAxis", MATRIX, "rotation-vector", lambda R: vector(RotationMatrix(R).ToAngleAxis())
        ),
        Function("AngleAxis, of a quaternion", QUATERNION, "rotation-vector", lambda q: vector(AngleAxis(unit(q)))),
        Function(
            "2 RotationMatrix.ToQuaternion, vector part",
            MATRIX,
            "sine-of-half",
            lambda R: 2.0 * RotationMatrix(R).ToQuaternion().xyz(),
        ),
        Function("RollPitchYaw", MATRIX, "z-y-x", lambda R: RollPitchYaw(RotationMatrix(R)).vector()),
    ),
)
