"""White noise on the measured orientation: R is turned by a random vector, drawn anew each period.

The level is its standard deviation about each axis.
"""

from tasks.condition import Axis, Condition

AXIS = Axis(
    "attitude-noise",
    "Noise on the orientation",
    "rad",
    (0.0, 0.001, 0.003, 0.01, 0.03),
    0.0,
    lambda level: Condition(attitude_noise=level),
)
