"""White noise on the measured orientation: R is turned by a random vector, drawn again each period."""

from tasks.axis import Axis, Field


def turn(level, R, now):
    """Return the drawn rotation vector [rad]."""
    return (level * now.noise[0], level * now.noise[1], level * now.noise[2])


AXIS = Axis(
    "attitude-noise",
    "Noise on the orientation",
    "rad",
    (0.0, 0.001, 0.003, 0.01, 0.03),
    0.0,
    (
        Field(
            "attitude_noise",
            0.0,
            "standard deviation about each axis [rad]",
            measured_turn=turn,
            lasts=True,
            is_drawn=True,
        ),
    ),
)
