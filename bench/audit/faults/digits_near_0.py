"""the error loses digits near the goal.

effect: near the goal the command flickers or is zero
cure: compute the angle by atan2(length of the vector part, scalar part), because an arc cosine loses digits; do not add
  a constant to a denominator; treat a length as zero only if it is exactly zero
unless: single-precision, deadband, euler-angles, norm-clip, axis-clip, long-way
"""

import numpy as np

from bench.audit.examined import COUNT_RAD, NOTE, Examined, Symptom

LARGEST_RAD = 0.01
LOST = 1e-9
"""Share of slope times a radian: rounding leaves 1e-16 here, an arc cosine 1e-8."""
NEARER_RAD = 1e-3
"""Digits are lost the more, the nearer the goal: an arc cosine errs by 1e-16 over the angle. An error that is larger
farther away is another fault."""


def find_known(examined: Examined) -> Symptom | None:
    """|e - truth| of the smallest rotations; a note if no encoder shows it."""
    angle = examined.pairs.angle
    here = examined.at("near-identity", "identity") & (angle <= LARGEST_RAD)
    # Of a size of its own nothing can be said along the axis.
    off = examined.error if examined.form else examined.size * np.sin(examined.apart)
    error = np.where(here, np.nan_to_num(off), 0.0) / examined.slope
    worst = int(np.argmax(error))
    if error[worst] <= LOST or angle[worst] > NEARER_RAD:
        return None
    text = f"off by up to {error[worst]:.2g} rad, at {angle[worst]:.2g} rad"
    if error[worst] > COUNT_RAD:
        return Symptom(text, examined.evidence(worst))
    return Symptom(
        f"{text}: less than a count of an encoder of 24 bits", examined.evidence(worst), NOTE
    )
