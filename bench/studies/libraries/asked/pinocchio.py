"""Pinocchio: logarithms of a matrix, of a quaternion and of a pose, and roll, pitch and yaw."""

import numpy as np
import pinocchio

from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library


def log3_of_quaternion(quat_wxyz) -> np.ndarray:
    """log3 of a Quaternion."""
    return pinocchio.log3(pinocchio.Quaternion(*quat_wxyz))


def log6(R) -> np.ndarray:
    """The angular part of log6, the logarithm of a pose; here one without translation."""
    return pinocchio.log6(pinocchio.SE3(R, np.zeros(3))).angular


def angle_axis(R) -> np.ndarray:
    """Eigen's AngleAxis."""
    found = pinocchio.AngleAxis(R)
    return found.angle * found.axis


LIBRARY = Library(
    "pinocchio",
    "pin",
    (
        Function("log3, of a matrix", MATRIX, pinocchio.log3),
        Function("log3, of a quaternion", QUATERNION, log3_of_quaternion),
        Function("log6, angular part", MATRIX, log6),
        Function("AngleAxis (Eigen)", MATRIX, angle_axis),
        Function("rpy.matrixToRpy", MATRIX, pinocchio.rpy.matrixToRpy, "z-y-x"),
    ),
)
