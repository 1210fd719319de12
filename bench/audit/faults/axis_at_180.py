"""at 180° the error has a wrong axis.

effect: at 180° or close to 180°, the robot starts to turn about an axis that is not the axis of the shortest rotation
cure: take the axis from the longest column of E + E^T + (1 - trace E) I, for E = R_d R^T
unless: digits-near-180, euler-angles, misaligned, axis-clip
"""

import numpy as np

from bench.audit.examined import Examined, Symptom
from bench.audit.faults.dead_at_180 import ZERO

OFF_AXIS_RAD = 0.01
"""Angle to the axis: a hundred thousand times what a root of rounding leaves, 1e-8."""
ROUNDING = 1e-13
"""Angle times the square of the distance to 180°: an arc cosine leaves 1e-15."""


def find_off_axis(examined: Examined) -> tuple[np.ndarray, np.ndarray]:
    """Return the pairs at 180° and next to it (two masks) with an answer off the axis, there beyond rounding."""
    off_axis, distance = np.fmin(examined.apart, np.pi - examined.apart), np.fmax(examined.pairs.distance, 1e-15)
    bad = (off_axis > OFF_AXIS_RAD) & (examined.size > ZERO * examined.slope * np.pi)
    by_rounding = np.fmax(ROUNDING / distance**2, 100.0 * examined.noise / distance)
    return bad & examined.at("at-180"), bad & examined.at("near-180") & (off_axis > by_rounding)


def find_known(examined: Examined) -> Symptom | None:
    """At 180° either direction along the axis is right, and nothing else; before it, beyond rounding, one."""
    if examined.form == "gibbs":
        return None  # it has no end there
    exact, before = find_off_axis(examined)
    text = f"{exact.sum()} of {examined.at('at-180').sum()} rotations by 180° are answered with another axis"
    if before.any():
        text += f", and so are rotations by up to {examined.pairs.distance[before].max():.2g} rad less"
    return examined.first(exact if exact.any() else before, text)
