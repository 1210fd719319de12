"""the length of the error is clipped.

effect: beyond the limit the stiffness decreases with the angle but the damping does not, so the robot moves slowly
cure: clip the command, not the error; or allow this fault, because the direction of the error stays right
unless: axis-clip
"""

import numpy as np

from bench.audit.convention import is_nearest
from bench.audit.examined import Examined, Symptom

FEWEST = 10
SAME = 1e-6
BENT_RAD = 1e-3
SHORTER = 0.999


def find_known(examined: Examined) -> Symptom | None:
    """Many answers have one length, or one largest component, and are shorter than they should be.

    Of a form of no name, shorter than a slope says that it has near the goal: a smooth one has its largest length at a
    few angles, not at many.
    """
    full = np.linalg.norm(examined.truth, axis=1)
    if not examined.form:
        full, near = examined.slope * examined.pairs.angle, is_nearest(examined.pairs)
        if not np.allclose(examined.size[near], full[near], rtol=1.0 - SHORTER, atol=0.0):
            return None
    here = np.flatnonzero(examined.at("wide", "close", "near-180") & (examined.apart < BENT_RAD))
    shorter = here[examined.size[here] < SHORTER * full[here]]
    for what, length in (("length", examined.size), ("largest component", np.abs(examined.e).max(axis=1))):
        limit = float(length[here].max(initial=0.0))
        at_limit = shorter[np.abs(length[shorter] - limit) <= SAME * limit]
        if len(at_limit) >= FEWEST and np.ptp(full[at_limit]) > (1.0 - SHORTER) * limit:
            return Symptom(
                f"the {what} never exceeds {limit:.6g}", examined.evidence(int(at_limit[-1]))
            )
    return None
