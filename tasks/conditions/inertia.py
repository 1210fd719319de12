"""A body whose inertia is the level times the law's model of it, alike about all axes."""

from tasks.axis import Axis, Field


def scale(level, moments):
    """Return the principal moments, each multiplied by its own factor."""
    return (level[0] * moments[0], level[1] * moments[1], level[2] * moments[2])


AXIS = Axis(
    "inertia",
    "Inertia over its model",
    "1",
    (0.5, 0.7, 1.0, 1.4, 2.0),
    1.0,
    (
        Field(
            "inertia",
            (1.0, 1.0, 1.0),
            "principal moments over the law's model, in the body's axes",
            inertia=scale,
            lasts=False,
        ),
    ),
    sets=lambda level: {"inertia": (level, level, level)},
)
