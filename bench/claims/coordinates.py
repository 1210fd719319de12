"""Coordinates that the paper sets aside (2.2), as maps to R, and the condition number of their rate maps."""

import math

import numpy as np

STEP = 1e-30
"""Of the complex-step derivative, which has no cancellation: any tiny number does."""


def turn(axis, angle):
    """Rodrigues' formula, complex numbers allowed."""
    x, y, z = axis
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * (K @ K)


def zyz(E):
    """R = Rz(alpha) Ry(beta) Rz(gamma)."""
    return turn((0, 0, 1), E[0]) @ turn((0, 1, 0), E[1]) @ turn((0, 0, 1), E[2])


def angle_and_axis(E):
    """R from its angle, and the polar and azimuth angle of its axis."""
    return turn((np.sin(E[1]) * np.cos(E[2]), np.sin(E[1]) * np.sin(E[2]), np.cos(E[1])), E[0])


def rotation_vector(E):
    """R from axis times angle."""
    angle = np.sqrt(E[0] * E[0] + E[1] * E[1] + E[2] * E[2])
    return turn(E / angle, angle)


def condition(to_matrix, E) -> float:
    """Condition number of the map from Edot to omega: column i is vee(dR/dE_i R^T)."""
    E = np.asarray(E, dtype=float)
    R = to_matrix(E)
    slopes = [to_matrix(E + 1j * STEP * unit).imag / STEP @ R.T for unit in np.eye(3)]
    return float(np.linalg.cond(np.array([(S[2, 1], S[0, 2], S[1, 0]) for S in slopes]).T))


def coordinates_of(axis, angle) -> dict:
    """The three sets of coordinates of one rotation; Z-Y-Z from its third column."""
    x, y, z = axis
    a = turn(axis, angle)[:, 2]
    return {
        zyz: (math.atan2(a[1], a[0]), math.atan2(math.hypot(a[0], a[1]), a[2]), 0.0),
        angle_and_axis: (angle, math.acos(z), math.atan2(y, x)),
        rotation_vector: angle * np.asarray(axis),
    }
