"""each component of the error is clipped, which changes the direction of the error.

effect: far from the goal the robot turns about an axis that is not the axis of the shortest rotation
cure: if the error is longer than the limit, scale the whole error vector down to the limit
"""

import numpy as np

from bench.audit.examined import Examined, Symptom

FEWEST = 10
"""Answers that share their largest component: of drawn pairs no two do."""
SAME = 1e-6
BENT_RAD = 1e-3


def find_known(examined: Examined) -> Symptom | None:
    """Many answers have the same largest component, and leave the axis."""
    here = np.flatnonzero(examined.at("wide", "close", "pole") & np.isfinite(examined.e).all(axis=1))
    largest = np.abs(examined.e[here]).max(axis=1)
    limit = float(largest.max(initial=0.0))
    at_limit = here[np.abs(largest - limit) <= SAME * limit]
    off_axis = np.minimum(examined.apart, np.pi - examined.apart)  # against the axis is another fault
    bent = at_limit[off_axis[at_limit] > BENT_RAD]
    if len(at_limit) < FEWEST or len(bent) < len(at_limit) / 2:
        return None
    worst = int(bent[np.argmax(off_axis[bent])])
    text = f"no component exceeds {limit:.6g}; the direction changes by up to {np.degrees(off_axis[worst]):.3g}°"
    return Symptom(text, examined.evidence(worst))
