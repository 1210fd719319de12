"""Points spread evenly over the sphere."""

import math

import numpy as np


def axes(count: int) -> np.ndarray:
    """Directions spread evenly over the sphere by the golden angle."""
    k = np.arange(count) + 0.5
    z = 1.0 - 2.0 * k / count
    turn = math.pi * (3.0 - math.sqrt(5.0)) * k
    radius = np.sqrt(1.0 - z * z)
    return np.column_stack((radius * np.cos(turn), radius * np.sin(turn), z))
