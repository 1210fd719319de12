"""wrong axis at 180°.

effect: at 180°, and next to it, the robot starts about another axis than the shortest way has
cure: take the axis from the column of R + R^T with the largest diagonal element: signs and all
unless: digits-near-180, euler-angles, misaligned, axis-clip
"""

import numpy as np

from bench.audit.examined import Examined, Found
from bench.audit.faults.dead_at_180 import ZERO

ASTRAY_RAD = 0.01
"""Angle to the axis: a hundred thousand times what a root of rounding leaves, 1e-8."""


def find_known(examined: Examined) -> Found | None:
    """At 180° either direction along the axis is right, and nothing else."""
    alive = examined.size > ZERO * examined.slope * np.pi
    here = examined.at("at-180") & np.isfinite(examined.apart) & alive
    bad = here & (examined.apart > ASTRAY_RAD)
    text = f"{bad.sum()} of {examined.at('at-180').sum()} rotations by 180° are answered with another axis"
    return examined.first(bad, text)
