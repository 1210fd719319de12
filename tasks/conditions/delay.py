"""How late a command takes effect. Until the first arrives the body is left alone."""

from tasks.condition import Axis, Condition

AXIS = Axis("delay", "Delay", "s", (0.0, 0.002, 0.005, 0.01, 0.015, 0.02), 0.0, lambda level: Condition(delay_s=level))
