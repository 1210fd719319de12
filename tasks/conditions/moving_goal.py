"""A goal that sways about two axes; the law is told its rate and acceleration."""

from __future__ import annotations

from tasks.condition import RATE_AND_ACCELERATION, Axis, Condition, spread


def at(level: float) -> Condition:
    """A goal of peak rate `level`."""
    return Condition(sway=level, told=RATE_AND_ACCELERATION)


AXIS = Axis(
    "moving-goal",
    "Goal that moves, its rate and acceleration told",
    "rad/s",
    (0.0, 0.5, 1.0, 2.0, 5.0, 10.0),
    0.0,
    at,
    spread,
)
