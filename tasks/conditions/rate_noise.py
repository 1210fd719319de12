"""White noise on the measured angular velocity, drawn anew each period."""

from __future__ import annotations

from tasks.condition import Axis, Condition, spread


def at(level: float) -> Condition:
    """A standard deviation of `level` about each axis."""
    return Condition(rate_noise=level)


AXIS = Axis("rate-noise", "Noise on the rate", "rad/s", (0.0, 0.01, 0.03, 0.1, 0.3, 1.0), 0.0, at, spread)
