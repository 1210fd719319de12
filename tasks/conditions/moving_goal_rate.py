"""A goal oscillating about two axes, at a peak rate of the level; its rate is feedforward, its acceleration is not."""

from tasks.axis import Axis
from tasks.moving_goal import RATE

AXIS = Axis(
    "moving-goal-rate",
    "Moving goal, feedforward of its rate",
    "rad/s",
    (0.0, 0.5, 1.0, 2.0, 5.0, 10.0),
    0.0,
    sets=lambda level: {"reference_amplitude": level, "feedforward": RATE},
)
