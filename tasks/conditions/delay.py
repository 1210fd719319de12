"""How late a command takes effect. Until the first arrives the body is left alone."""

from tasks.axis import Axis, Field

AXIS = Axis(
    "delay",
    "Delay",
    "s",
    (0.0, 0.002, 0.005, 0.01, 0.015, 0.02),
    0.0,
    (
        Field(
            "delay_s",
            0.0,
            "time from measuring to the command's effect [s]",
            in_loop=True,
            lasts=False,
        ),
    ),
)
