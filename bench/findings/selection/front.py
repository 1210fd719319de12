"""The Pareto front: what is not beaten in everything at once."""

import numpy as np


def front(points: np.ndarray) -> np.ndarray:
    """Which points no other dominates: at least as good in every column, and better in one (Pareto 1906).

    Equal points are on the front together or not at all; a point that is not a number in some column is not on it.

    Args:
        points: less is better, shape (n, m).

    Returns: True of each point on the front, shape (n,).
    """
    points = np.asarray(points, dtype=float)
    is_known = ~np.isnan(points).any(axis=1)
    no_worse = np.all(points[:, None, :] <= points[None, :, :], axis=2)
    better = np.any(points[:, None, :] < points[None, :, :], axis=2)
    dominated = np.any(np.logical_and(no_worse, better), axis=0)
    return is_known & ~dominated
