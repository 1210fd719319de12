"""Low-discrepancy points on SO(3), on the ball of initial angular velocities, and on the sphere.

A scrambled Halton sequence in the unit cube, mapped to unit quaternions by the subgroup algorithm (K.
Shoemake, "Uniform random rotations", Graphics Gems III, 1992), which carries the uniform density of the cube
to the Haar measure. The angle of such a rotation has the density (1 - cos theta)/pi on [0, pi]: its median is
132 degrees and 11 % lie within 10 degrees of a 180° rotation.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator

import numpy as np

from tasks.base import Quat, Vector

BLOCK = 256  # points that `endless` makes together


def halton(count: int, dimensions: int, seed: int, first: int = 0) -> list[list[float]]:
    """Return `count` points of this seed's scrambled Halton sequence, from the point `first` on."""
    from scipy.stats import qmc  # two seconds to import; the directed sets do not need it

    sequence = qmc.Halton(d=dimensions, scramble=True, rng=seed)
    sequence.num_generated = first  # a point follows from its number alone; fast_forward would make all those before
    return sequence.random(count).tolist()


def endless(dimensions: int, seed: int) -> Iterator[list[float]]:
    """Yield the points of this seed's sequence one after the other."""
    for first in itertools.count(0, BLOCK):
        yield from halton(BLOCK, dimensions, seed, first)


def orientation(u: float, v: float, w: float) -> Quat:
    """Return the unit quaternion of a point of the unit cube: Haar measure for uniform (u, v, w)."""
    inner, outer = math.sqrt(1.0 - u), math.sqrt(u)
    p, q = math.tau * v, math.tau * w
    return (outer * math.cos(q), inner * math.sin(p), inner * math.cos(p), outer * math.sin(q))


def direction(v: float, w: float) -> Vector:
    """Return the unit vector of a point of the unit square: uniform on the sphere (z is uniform, by Archimedes)."""
    z, azimuth = 2.0 * v - 1.0, math.tau * w
    radius = math.sqrt(1.0 - z * z)
    return (radius * math.cos(azimuth), radius * math.sin(azimuth), z)


def axes(count: int) -> np.ndarray:
    """Directions spread evenly over the sphere by the golden angle."""
    k = np.arange(count) + 0.5
    z = 1.0 - 2.0 * k / count
    turn = math.pi * (3.0 - math.sqrt(5.0)) * k
    radius = np.sqrt(1.0 - z * z)
    return np.column_stack((radius * np.cos(turn), radius * np.sin(turn), z))
