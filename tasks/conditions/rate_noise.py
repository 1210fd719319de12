"""White noise on the measured angular velocity, drawn again each period."""

from tasks.axis import Axis, Field


def add_noise(level, omega, now):
    """Return the angular velocity with drawn errors [rad/s]."""
    x, y, z = omega
    return (x + level * now.noise[3], y + level * now.noise[4], z + level * now.noise[5])


AXIS = Axis(
    "rate-noise",
    "Noise on the rate",
    "rad/s",
    (0.0, 0.01, 0.03, 0.1, 0.3, 1.0),
    0.0,
    (
        Field(
            "rate_noise",
            0.0,
            "standard deviation about each axis [rad/s]",
            measured_rate=add_noise,
            lasts=True,
            is_drawn=True,
        ),
    ),
)
