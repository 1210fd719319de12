"""Robotics Toolbox for Python: what its servo and its inverse kinematics take for the error."""

from functools import partial

import numpy as np
import roboticstoolbox
from spatialmath import base

from bench.studies.libraries.free_body import driven
from bench.studies.libraries.library import MATRIX, Controller, Function, Library

DT_S = 0.05


def p_servo(method):
    """The angular part of p_servo, from the identity."""

    def called(R) -> np.ndarray:
        return roboticstoolbox.p_servo(np.eye(4), base.r2t(R), method=method)[0][3:]

    return called


def servoed(method) -> Controller:
    """The velocity that p_servo gives in the frame of the tool, in base coordinates, with its default gain of 1."""

    def velocity(T) -> np.ndarray:
        return T.T @ roboticstoolbox.p_servo(base.r2t(T.T), np.eye(4), gain=1.0, method=method)[0][3:]

    name = 'p_servo(method="angle-axis")' if method == "angle-axis" else "p_servo, by default"
    return Controller(name, name, "velocity", "gain 1, 20 Hz", DT_S, partial(driven, velocity, DT_S))


LIBRARY = Library(
    "roboticstoolbox",
    "roboticstoolbox-python",
    (
        Function("angle_axis", MATRIX, lambda R: roboticstoolbox.angle_axis(np.eye(4), base.r2t(R))[3:]),
        Function('p_servo(method="angle-axis")', MATRIX, p_servo("angle-axis")),
        Function("p_servo, by default", MATRIX, p_servo("rpy"), "z-y-x"),
    ),
    (servoed("angle-axis"), servoed("rpy")),
)
