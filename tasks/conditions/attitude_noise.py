"""White noise on the measured orientation: R is turned by a random vector, drawn anew each period."""

from __future__ import annotations

from tasks.condition import Axis, Condition, spread


def at(level: float) -> Condition:
    """A standard deviation of `level` about each axis."""
    return Condition(attitude_noise=level)


AXIS = Axis("attitude-noise", "Noise on the orientation", "rad", (0.0, 0.001, 0.003, 0.01, 0.03), 0.0, at, spread)
