"""Condition numbers of B, from coordinate rates to angular velocity, in coordinates the paper sets aside (2.2)."""

import math

import numpy as np

from bench.contenders.registry import representation
from bench.law.so3 import Rotation

STEP = 1e-30
"""Of the complex-step derivative, which has no cancellation: any tiny number does."""

ANGLE_AND_AXIS = "angle and axis"
"""The angle, and the polar and azimuth angle of the axis: coordinates that no controller here uses."""


def turn(axis, angle):
    """Rodrigues' formula, complex numbers allowed."""
    x, y, z = axis
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * (K @ K)


def condition_in(word: str, R: Rotation) -> float:
    """Condition number of B (2.8) of a representation at R."""
    coordinates = representation(word)
    at = coordinates.chart(R)
    columns = [coordinates.angular_velocity(at, tuple(unit)) for unit in np.eye(len(coordinates.symbols)).tolist()]
    return float(np.linalg.cond(np.array(columns).T))


def condition_of_angle_and_axis(E) -> float:
    """The same of angle and axis: column i is vee(dR/dE_i R^T)."""

    def to_matrix(E):
        axis = (np.sin(E[1]) * np.cos(E[2]), np.sin(E[1]) * np.sin(E[2]), np.cos(E[1]))
        return turn(axis, E[0])

    R = to_matrix(E)
    slopes = [to_matrix(E + 1j * STEP * unit).imag / STEP @ R.T for unit in np.eye(3)]
    return float(np.linalg.cond(np.array([(S[2, 1], S[0, 2], S[1, 0]) for S in slopes]).T))


def conditions(axis, angle) -> dict[str, float]:
    """The condition number in three sets of coordinates of one rotation, by their names."""
    x, y, z = axis
    R = Rotation(*(tuple(column) for column in turn(axis, angle).T.tolist()))
    of_axis = condition_of_angle_and_axis(np.array((angle, math.acos(z), math.atan2(y, x))))
    return {
        "zyz-euler": condition_in("zyz-euler", R),
        ANGLE_AND_AXIS: of_axis,
        "rotation-vector": condition_in("rotation-vector", R),
    }
