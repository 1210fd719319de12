"""A goal oscillating about two axes, at a peak rate of the level; its rate and acceleration are feedforward."""

from tasks.condition import RATE_AND_ACCELERATION, Axis, Condition

AXIS = Axis(
    "moving-goal",
    "Moving goal, full feedforward",
    "rad/s",
    (0.0, 0.5, 1.0, 2.0, 5.0, 10.0),
    0.0,
    lambda level: Condition(reference_amplitude=level, feedforward=RATE_AND_ACCELERATION),
)
