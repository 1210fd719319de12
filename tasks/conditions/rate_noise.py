"""White noise on the measured angular velocity, drawn anew each period.

The level is its standard deviation about each axis.
"""

from tasks.condition import Axis, Condition

AXIS = Axis(
    "rate-noise",
    "Noise on the rate",
    "rad/s",
    (0.0, 0.01, 0.03, 0.1, 0.3, 1.0),
    0.0,
    lambda level: Condition(rate_noise=level),
)
