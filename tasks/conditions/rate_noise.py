"""White noise on the measured angular velocity, drawn again each period."""

from tasks.axis import Axis, Field

AXIS = Axis(
    "rate-noise",
    "Noise on the rate",
    "rad/s",
    (0.0, 0.01, 0.03, 0.1, 0.3, 1.0),
    0.0,
    (Field("rate_noise", 0.0, "standard deviation about each axis [rad/s]", lasts=True, is_drawn=True),),
)
