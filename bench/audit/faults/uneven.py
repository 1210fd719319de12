"""another size for some pairs.

effect: the stiffness felt changes from place to place, and jumps at the edge between two
cure: compute the size from the angle between the two orientations alone
unless: norm-clip, axis-clip, deadband, jump, long-way, misaligned, euler-angles, single-precision, digits-near-0,
  digits-near-180, memory
"""

import numpy as np

from bench.audit.examined import Examined, Found

DEVIATION = 1e-3
"""Share of the size that the form has: single precision leaves 1e-6."""
SMALLEST_RAD = 1e-4
"""Digits may be lost at smaller angles."""


def find(examined: Examined) -> Found | None:
    """Most sizes are those of a form, and some are not, along the axis all the same."""
    if not examined.form:
        return None
    right = np.linalg.norm(examined.truth, axis=1)
    here = ~examined.at("at-180", "identity", "near-180") & (examined.pairs.angle > SMALLEST_RAD)
    with np.errstate(invalid="ignore", divide="ignore"):
        ratio = examined.size / right
        bad = here & (np.abs(ratio - 1.0) > DEVIATION)
    if not bad.any():
        return None
    return Found(
        f"for {bad.sum()} of {here.sum()} pairs |e| is {np.nanmin(ratio[bad]):.3g} to {np.nanmax(ratio[bad]):.3g} "
        "times what it is for others of the same angle",
        examined.evidence(int(np.argmax(bad))),
    )
