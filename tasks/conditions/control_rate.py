"""How often the law is asked. Between two ticks its command is held."""

from __future__ import annotations

from tasks.condition import Axis, Condition, spread


def at(level: float) -> Condition:
    """Asked `level` times a second."""
    return Condition(period_s=1.0 / level)


AXIS = Axis(
    "control-rate",
    "Control rate",
    "Hz",
    (20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0, 10_000.0),
    1000.0,
    at,
    spread,
)
