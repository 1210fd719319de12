"""digits lost near 180°.

effect: near 180° the command has a wrong size or a wrong axis, and flickers
cure: do not divide by sin(theta): begin with a quaternion from the largest diagonal element
unless: single-precision, misaligned, euler-angles, axis-clip, long-way
"""

import numpy as np

from bench.audit.examined import COUNT_RAD, Examined, Found

FARTHEST_RAD = 0.1


def find_known(examined: Examined) -> Found | None:
    """Find what is across the axis; and along it, if the size is right 0.1 rad before."""
    here = examined.at("near-180") & (examined.size > 0.0)
    error = np.fmin(examined.size, np.pi * examined.slope) * np.sin(examined.apart)
    is_endless = examined.form == "gibbs"  # at 180°, where no digit of its size can be kept
    before = examined.error[here & (examined.pairs.distance > FARTHEST_RAD)]
    if not is_endless and np.nanmax(before, initial=0.0) < COUNT_RAD:
        error = np.fmax(error, examined.error)
    error = np.where(here, error, 0.0) / examined.slope
    if not (error > COUNT_RAD).any():
        return None
    worst = int(np.nanargmax(error))
    distance = examined.pairs.distance[worst]
    return Found(f"off by up to {error[worst]:.2g} rad, {distance:.2g} rad before 180°", examined.evidence(worst))
