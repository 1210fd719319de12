"""A body lighter or heavier than the law's model of it, alike about all axes."""

from __future__ import annotations

from tasks.condition import Axis, Condition, spread


def at(level: float) -> Condition:
    """True inertia `level` times the model's."""
    return Condition(inertia=(level, level, level))


AXIS = Axis("inertia", "Inertia over its model", "1", (0.5, 0.7, 1.0, 1.4, 2.0), 1.0, at, spread)
