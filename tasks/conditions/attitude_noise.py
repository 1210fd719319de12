"""White noise on the measured orientation: R is turned by a random vector, drawn again each period."""

from tasks.axis import Axis, Field

AXIS = Axis(
    "attitude-noise",
    "Noise on the orientation",
    "rad",
    (0.0, 0.001, 0.003, 0.01, 0.03),
    0.0,
    (Field("attitude_noise", 0.0, "standard deviation about each axis [rad]", lasts=True, is_drawn=True),),
)
