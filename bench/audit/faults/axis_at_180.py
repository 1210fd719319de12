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
ROUNDING = 1e-13
"""Angle times the square of the distance to 180°: an arc cosine leaves 1e-15."""


def find_wrong_before(examined: Examined) -> np.ndarray:
    """Return the pairs next to 180° (n, a mask) whose answers are off the axis by more than rounding."""
    by_rounding = ROUNDING / examined.pairs.distance**2
    return find_astray(examined) & examined.at("near-180") & (examined.apart > by_rounding)


def find_astray(examined: Examined) -> np.ndarray:
    """Return the pairs (n, a mask) with an answer that is off the axis."""
    return (examined.apart > ASTRAY_RAD) & (examined.size > ZERO * examined.slope * np.pi)


def find_known(examined: Examined) -> Found | None:
    """At 180° either direction along the axis is right, and nothing else; before it, beyond rounding, one."""
    exact, before = find_astray(examined) & examined.at("at-180"), find_wrong_before(examined)
    text = f"{exact.sum()} of {examined.at('at-180').sum()} rotations by 180° are answered with another axis"
    if before.any():
        text += f", and so are rotations by up to {examined.pairs.distance[before].max():.2g} rad less"
    return examined.first(exact if exact.any() else before, text)
