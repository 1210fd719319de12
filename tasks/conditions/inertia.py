"""A body whose inertia is the level times the law's model of it, alike about all axes."""

from tasks.axis import Axis, Field

AXIS = Axis(
    "inertia",
    "Inertia over its model",
    "1",
    (0.5, 0.7, 1.0, 1.4, 2.0),
    1.0,
    (Field("inertia", (1.0, 1.0, 1.0), "principal moments over the law's model, in the body's axes", lasts=False),),
    sets=lambda level: {"inertia": (level, level, level)},
)
