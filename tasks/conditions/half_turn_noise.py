"""The worst noise at 180°: within `level` of it the body is reported beyond it.

A law that looks at the reported orientation alone turns back whenever the body is about to leave, and is held at the
180° rotation for good, however small the noise (Mayhew, Sanfelice, Teel 2011, of laws that jump there; a law that is
continuous is at rest there anyway). Asked now and then, it is held by what exceeds the body's turn in a period. Memory
lets a law keep to the way it has begun.
"""

from __future__ import annotations

import math

from tasks.axis import Axis, Field
from tasks.base import Start
from tasks.haar import direction, halton
from tasks.rotations import short_of_180_degrees


def starts(count: int, seed: int, level: float) -> list[Start]:
    """Exact 180° rotations about axes spread evenly over the sphere, at rest."""
    axes = [direction(*point) for point in halton(count, 2, seed)]
    return [Start(f"exact-{i:04d}", short_of_180_degrees(axis, 0.0)) for i, axis in enumerate(axes)]


def report_beyond(level, angle, now):
    """Return the level where this reaches beyond 180°, else 0 [rad]."""
    return level if angle + level > math.pi else 0.0


AXIS = Axis(
    "half-turn-noise",
    "Worst noise at 180°",
    "rad",
    (0.0, 0.001, 0.01, 0.03, 0.1, 0.3, 1.0),
    0.0,
    (
        Field(
            "worst_attitude_error",
            0.0,
            "how far the body is reported beyond 180° [rad]",
            measured_away=report_beyond,
            lasts=False,
        ),
    ),
    starts=starts,
)
