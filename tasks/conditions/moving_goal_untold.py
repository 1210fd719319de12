"""A goal that sways about two axes; the law is told where it is, and nothing of how it moves."""

from __future__ import annotations

from tasks.condition import UNTOLD, Axis, Condition, spread


def at(level: float) -> Condition:
    """A goal of peak rate `level`."""
    return Condition(sway=level, told=UNTOLD)


AXIS = Axis("moving-goal-untold", "Goal that moves untold", "rad/s", (0.0, 0.5, 1.0, 2.0, 5.0, 10.0), 0.0, at, spread)
