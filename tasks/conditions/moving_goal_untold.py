"""A goal that sways about two axes, at a peak rate of the level; the law is told where it is, not how it moves."""

from tasks.condition import UNTOLD, Axis, Condition

AXIS = Axis(
    "moving-goal-untold",
    "Goal that moves untold",
    "rad/s",
    (0.0, 0.5, 1.0, 2.0, 5.0, 10.0),
    0.0,
    lambda level: Condition(sway=level, told=UNTOLD),
)
