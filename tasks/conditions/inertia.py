"""A body whose inertia is the level times the law's model of it, alike about all axes."""

from tasks.condition import Axis, Condition

AXIS = Axis(
    "inertia",
    "Inertia over its model",
    "1",
    (0.5, 0.7, 1.0, 1.4, 2.0),
    1.0,
    lambda level: Condition(inertia=(level, level, level)),
)
