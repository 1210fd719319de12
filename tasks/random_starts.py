"""Random starts in blocks, each from its number alone, by arithmetic that every machine rounds alike.

Orientations have the Haar measure: two points of the unit disc make one of the sphere in four dimensions (G. Marsaglia,
"Choosing a point from the surface of a sphere", Ann. Math. Stat. 43, 1972). Points of the disc are those of the square
that lie in it, so that nothing but + - * / and square roots is taken of the generator's numbers (Philox, whose state is
a counter: J. Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC 2011).
"""

from __future__ import annotations

import numpy as np

BLOCK = 16_384
"""Starts of a block."""


def block(number: int, seed: int, most_speed: float = 0.0, least_speed: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """Return orientations wxyz, shape (BLOCK, 4), and angular velocities [rad/s], shape (BLOCK, 3), of one block.

    Speeds are uniform from least_speed to most_speed [rad/s], directions uniform on the sphere.
    """
    random = np.random.Generator(np.random.Philox(key=np.array([seed, number], dtype=np.uint64)))
    (a, a_squared), (b, b_squared), (c, c_squared) = (_in_disc(random) for _ in range(3))
    quats = np.column_stack((a, b * np.sqrt((1.0 - a_squared) / b_squared)[:, None]))
    radius = 2.0 * np.sqrt(1.0 - c_squared)
    directions = np.column_stack((c * radius[:, None], 1.0 - 2.0 * c_squared))
    speeds = least_speed + (most_speed - least_speed) * random.random((BLOCK, 1))
    return quats, speeds * directions


def _in_disc(random: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """BLOCK points of the unit disc without its centre, and their squared distances from it."""
    found: list[np.ndarray] = []
    while sum(map(len, found)) < BLOCK:
        points = 2.0 * random.random((BLOCK, 2)) - 1.0
        squared = points[:, 0] * points[:, 0] + points[:, 1] * points[:, 1]
        found.append(points[(squared < 1.0) & (squared > 0.0)])
    points = np.concatenate(found)[:BLOCK]
    return points, points[:, 0] * points[:, 0] + points[:, 1] * points[:, 1]
