"""How late a command takes effect. Until the first arrives the body is left alone."""

from __future__ import annotations

from tasks.condition import Axis, Condition, spread


def at(level: float) -> Condition:
    """Late by `level` seconds."""
    return Condition(delay_s=level)


AXIS = Axis("delay", "Delay", "s", (0.0, 0.002, 0.005, 0.01, 0.015, 0.02), 0.0, at, spread)
