"""Robotics Toolbox for Python: what its servo and its inverse kinematics take for the error."""

import numpy as np
import roboticstoolbox
from spatialmath import base

from bench.studies.libraries.library import MATRIX, Function, Library


def p_servo(method):
    """The angular part of p_servo, from the identity."""

    def called(R) -> np.ndarray:
        return roboticstoolbox.p_servo(np.eye(4), base.r2t(R), method=method)[0][3:]

    return called


LIBRARY = Library(
    "roboticstoolbox",
    "roboticstoolbox-python",
    (
        Function("angle_axis", MATRIX, lambda R: roboticstoolbox.angle_axis(np.eye(4), base.r2t(R))[3:]),
        Function('p_servo(method="angle-axis")', MATRIX, p_servo("angle-axis")),
        Function("p_servo, by default", MATRIX, p_servo("rpy"), "z-y-x"),
    ),
)
