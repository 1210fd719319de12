"""Orientations spread over SO(3) with an initial angular velocity of up to 20 rad/s in any direction.

Speeds are uniform on [0, 20] rad/s and directions uniform on the sphere: a quarter of the starts is above 15 rad/s, at
which the damping Kv omega = 300 rad/s^2 is as large as the greatest spring term, 100 pi.
"""

from __future__ import annotations

from tasks.base import Start, StartSet
from tasks.haar import direction, halton, orientation

SPEED_LIMIT = 20.0  # [rad/s]


def between(first: int, end: int, seed: int) -> list[Start]:
    """Return the points from `first` to before `end`."""
    starts = []
    for i, point in enumerate(halton(end - first, 6, seed, first), first):
        x, y, z = direction(point[3], point[4])
        speed = SPEED_LIMIT * point[5]
        starts.append(Start(f"tumbling-{i:04d}", orientation(*point[:3]), (speed * x, speed * y, speed * z)))
    return starts


STARTS = StartSet("tumbling", "Uniform orientations turning at up to 20 rad/s", 200, between=between)
