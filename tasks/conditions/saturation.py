"""The most a motor gives: a longer command is shortened, its direction kept."""

import math

from tasks.axis import Axis, Field

AXIS = Axis(
    "saturation",
    "Bound on the command",
    "rad/s^2",
    (10.0, 20.0, 50.0, 100.0, 300.0, 1000.0),
    None,
    (Field("bound", math.inf, "what |u| is cut to [rad/s^2]", lasts=False),),
)
