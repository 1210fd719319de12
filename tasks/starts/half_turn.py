"""Rotations by pi - 10^-k, k = 0 to 12, and by exactly pi, about axes of several kinds.

A 180° rotation makes the rotation-matrix error vanish (Murphy 1988, 2.12 and section 2.4). Exact ones have w = 0,
so that R is symmetric bit for bit and the error is exactly zero whatever the axis.
"""

from __future__ import annotations

import numpy as np

from tasks.base import Start, StartSet, Vector
from tasks.rotations import short_of_180_degrees, unit

AXES: dict[str, Vector] = {
    "x": (1.0, 0.0, 0.0),
    "y": (0.0, 1.0, 0.0),
    "z": (0.0, 0.0, 1.0),
    # face diagonals; "x-z" is x minus z
    "xy": (1.0, 1.0, 0.0),
    "x-y": (1.0, -1.0, 0.0),
    "xz": (1.0, 0.0, 1.0),
    "x-z": (1.0, 0.0, -1.0),
    "yz": (0.0, 1.0, 1.0),
    "y-z": (0.0, 1.0, -1.0),
    # space diagonals
    "xyz": (1.0, 1.0, 1.0),
    "xy-z": (1.0, 1.0, -1.0),
    "x-yz": (1.0, -1.0, 1.0),
    "x-y-z": (1.0, -1.0, -1.0),
}
RANDOM_AXES = 4
DECADES = range(13)


def build(seed: int) -> list[Start]:
    """Return exact 180° rotations first, then every axis at pi - 1 rad, pi - 0.1 rad, ...; seed draws random axes."""
    # generic axes, uniform on the sphere: no element is zero and no two are equal
    drawn = np.random.default_rng(seed).normal(size=(RANDOM_AXES, 3)).tolist()
    axes = AXES | {f"random{i}": unit((x, y, z)) for i, (x, y, z) in enumerate(drawn)}
    starts = [Start(f"half-turn-{name}-exact", short_of_180_degrees(axis, 0.0)) for name, axis in axes.items()]
    for k in DECADES:
        starts += [Start(f"half-turn-{name}-k{k:02d}", short_of_180_degrees(v, 10.0**-k)) for name, v in axes.items()]
    return starts


STARTS = StartSet(
    "half-turn",
    "Rotations by pi - 10^-k and by exactly pi",
    (len(AXES) + RANDOM_AXES) * (len(DECADES) + 1),
    build,
)
