"""pyquaternion: axis, angle and logarithm of a quaternion, which may be made of a matrix."""

import numpy as np
from pyquaternion import Quaternion

from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library


def vector(found: Quaternion) -> np.ndarray:
    """Angle times axis."""
    return found.angle * found.axis


def logarithm(quat_wxyz) -> np.ndarray:
    """Twice the vector part of Quaternion.log."""
    return 2.0 * Quaternion.log(Quaternion(*quat_wxyz)).vector


LIBRARY = Library(
    "pyquaternion",
    "pyquaternion",
    (
        Function("angle, axis", QUATERNION, lambda q: vector(Quaternion(*q))),
        Function("angle, axis, of a matrix", MATRIX, lambda R: vector(Quaternion(matrix=R))),
        Function("2 log, vector part", QUATERNION, logarithm, is_idiom=True, fix="`angle * axis`"),
    ),
)
