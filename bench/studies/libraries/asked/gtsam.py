"""GTSAM: the logarithm of Rot3."""

import gtsam
import numpy as np

from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library


def axis_angle(R) -> np.ndarray:
    """Rot3.axisAngle as one vector."""
    axis, angle = gtsam.Rot3(R).axisAngle()
    return angle * np.ravel(axis.point3())


LIBRARY = Library(
    "gtsam",
    "gtsam",
    (
        Function("Rot3.Logmap", MATRIX, lambda R: gtsam.Rot3.Logmap(gtsam.Rot3(R))),
        Function("Rot3.axisAngle", MATRIX, axis_angle),
        Function("Rot3.Logmap, of a quaternion", QUATERNION, lambda q: gtsam.Rot3.Logmap(gtsam.Rot3.Quaternion(*q))),
        Function("Rot3.rpy", MATRIX, lambda R: gtsam.Rot3(R).rpy(), "z-y-x"),
    ),
)
