"""A goal that sways about two axes; the law is told its rate, and no acceleration."""

from __future__ import annotations

from tasks.condition import RATE, Axis, Condition, spread


def at(level: float) -> Condition:
    """A goal of peak rate `level`."""
    return Condition(sway=level, told=RATE)


AXIS = Axis(
    "moving-goal-rate", "Goal that moves, its rate told", "rad/s", (0.0, 0.5, 1.0, 2.0, 5.0, 10.0), 0.0, at, spread
)
