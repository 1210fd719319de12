"""A body that turns already when the law is switched on."""

from __future__ import annotations

from tasks.axis import Axis
from tasks.base import Start
from tasks.haar import direction, halton, orientation


def starts(count: int, seed: int, level: float) -> list[Start]:
    """Orientations spread evenly over SO(3), each turning at `level` rad/s about an axis of its own."""
    found = []
    for i, point in enumerate(halton(count, 5, seed)):
        x, y, z = direction(*point[3:])
        found.append(Start(f"spinning-{i:04d}", orientation(*point[:3]), (level * x, level * y, level * z)))
    return found


AXIS = Axis("spin", "Initial spin", "rad/s", (0.0, 5.0, 10.0, 15.0, 20.0), 0.0, starts=starts)
