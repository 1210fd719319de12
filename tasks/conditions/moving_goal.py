"""A goal oscillating about two axes, at a peak rate of the level; its rate and acceleration are feedforward."""

from tasks.axis import Axis, Field
from tasks.moving_goal import RATE_AND_ACCELERATION

AXIS = Axis(
    "moving-goal",
    "Moving goal, full feedforward",
    "rad/s",
    (0.0, 0.5, 1.0, 2.0, 5.0, 10.0),
    0.0,
    (
        Field("reference_amplitude", 0.0, "peak rate of a goal that moves [rad/s]", lasts=True),
        Field("feedforward", RATE_AND_ACCELERATION, "what the law is given of the goal's motion", lasts=False),
    ),
    sets=lambda level: {"reference_amplitude": level, "feedforward": RATE_AND_ACCELERATION},
)
