"""A body that is no ball, though the law's model is: moments 1 - s, 1 and 1 + s, and the gyroscopic torque with them.

No rigid body has s above 1/2: the two smaller moments sum to no less than the largest.
"""

from __future__ import annotations

from tasks.condition import Axis, Condition, spread


def at(level: float) -> Condition:
    """Principal moments 1 - level, 1 and 1 + level times the model's."""
    return Condition(inertia=(1.0 - level, 1.0, 1.0 + level))


AXIS = Axis("uneven-inertia", "Unevenness of the inertia", "1", (0.0, 0.1, 0.2, 0.3, 0.4, 0.5), 0.0, at, spread)
