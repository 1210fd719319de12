"""The most a motor gives: a longer command is shortened, its direction kept."""

import math

from tasks.axis import Axis, Field


def shorten(level, u, now):
    """Return the command, at most as long as the level."""
    squared = u[0] * u[0] + u[1] * u[1] + u[2] * u[2]
    if squared > level * level:
        scale = level / math.sqrt(squared)
        return (scale * u[0], scale * u[1], scale * u[2])
    return u


AXIS = Axis(
    "saturation",
    "Bound on the command",
    "rad/s^2",
    (10.0, 20.0, 50.0, 100.0, 300.0, 1000.0),
    None,
    (
        Field(
            "bound",
            math.inf,
            "what |u| is cut to [rad/s^2]",
            in_loop=True,
            commanded=shorten,
            lasts=False,
        ),
    ),
)
