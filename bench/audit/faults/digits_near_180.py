"""the error loses digits near 180°.

effect: near 180° the command flickers and has a wrong size or a wrong axis
cure: do not divide by sin(theta); first compute a quaternion from the largest diagonal element of the matrix
unless: single-precision, misaligned, euler-angles, axis-clip, norm-clip, long-way, deadband, jump
"""

import numpy as np

from bench.audit.examined import COUNT_RAD, Examined, Symptom
from bench.audit.faults import axis_at_180, dead_at_180

FARTHEST_RAD = 0.1


def find_known(examined: Examined) -> Symptom | None:
    """Find what is across the axis; and along it, if the size is right 0.1 rad before, and does not end in zero."""
    here = examined.at("near-180") & (examined.size > 0.0) & np.isfinite(examined.size)
    error = np.fmin(examined.size, np.pi * examined.slope) * np.sin(examined.apart)
    if examined.form == "gibbs" or axis_at_180.find_off_axis(examined)[1].any():
        return None  # a form without end at 180°, where no digit of it matters; or more than digits
    before = examined.error[here & (examined.pairs.distance > FARTHEST_RAD)]
    if np.nanmax(before, initial=0.0) < COUNT_RAD:
        is_dying = (examined.size < np.pi * examined.slope) & (dead_at_180.find_known(examined) is not None)
        error = np.fmax(error, np.where(is_dying, 0.0, examined.error))
    error = np.where(here, error, 0.0) / examined.slope
    if not (error > COUNT_RAD).any():
        return None
    worst = int(np.nanargmax(error))
    distance = examined.pairs.distance[worst]
    return Symptom(
        f"off by up to {error[worst]:.2g} rad, {distance:.2g} rad before 180°",
        examined.evidence(worst),
    )
