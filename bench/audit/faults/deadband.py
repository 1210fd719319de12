"""a dead band.

effect: the robot rests beside its goal, and an integral or a force near the edge makes it chatter
cure: leave it out; noise wants a filter
unless: single-precision
"""

import numpy as np

from bench.audit.examined import Examined, Found

SMALLEST_RAD = 1e-7
"""A dead band below this is none to a robot; the arc cosine's zero ends at 2e-8, and is a loss of digits."""
FEWEST = 10


def find_known(examined: Examined) -> Found | None:
    """e is exactly zero, or a component of it, up to an angle; beyond it is not."""
    small = examined.at("near-identity", "fine", "close")
    zero = small & (examined.pairs.angle >= SMALLEST_RAD) & (examined.size == 0.0)
    if zero.sum() < FEWEST:
        return None
    angle = examined.pairs.angle
    i = int(np.flatnonzero(zero)[np.argmax(angle[zero])])
    return Found(f"e = 0 up to {angle[i]:.3g} rad", examined.evidence(i))
