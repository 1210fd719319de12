"""The most a motor gives: a longer command is shortened, its direction kept."""

from tasks.condition import Axis, Condition

AXIS = Axis(
    "saturation",
    "Bound on the command",
    "rad/s^2",
    (10.0, 20.0, 50.0, 100.0, 300.0, 1000.0),
    None,
    lambda level: Condition(bound=level),
)
