"""How often a second the law is asked. Between two ticks its command is held."""

from tasks.condition import Axis, Condition

AXIS = Axis(
    "control-rate",
    "Control rate",
    "Hz",
    (20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0, 10_000.0),
    1000.0,
    lambda level: Condition(period_s=1.0 / level),
)
