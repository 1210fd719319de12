"""A goal oscillating about two axes, at a peak rate of the level; the law is given where it is, without feedforward."""

from tasks.axis import Axis
from tasks.moving_goal import NO_FEEDFORWARD

AXIS = Axis(
    "moving-goal-untold",
    "Moving goal, no feedforward",
    "rad/s",
    (0.0, 0.5, 1.0, 2.0, 5.0, 10.0),
    0.0,
    sets=lambda level: {"reference_amplitude": level, "feedforward": NO_FEEDFORWARD},
)
