"""How often a second the law is asked. Between two ticks its command is held."""

from tasks.axis import Axis, Field

AXIS = Axis(
    "control-rate",
    "Control rate",
    "Hz",
    (20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0, 10_000.0),
    1000.0,
    (
        Field(
            "period_s",
            1e-3,
            "time from one command to the next, which holds the first [s]",
            in_loop=True,
            lasts=False,
        ),
    ),
    sets=lambda level: {"period_s": 1.0 / level},
)
