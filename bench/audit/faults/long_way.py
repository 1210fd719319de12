"""the error points along the longer way to the goal (unwinding), because an angle or a sign is wrong.

effect: the robot turns by up to 360° although a small rotation would be enough; the command jumps where the error
  changes from one way to the other
cure: wrap angles to [-180°, 180°], use atan2 instead of an arc tangent, and change the sign of a quaternion with a
  negative scalar part
law: quaternion-shortest
"""

import numpy as np

from bench.audit.examined import Examined, Symptom
from bench.audit.faults.euler_angles import SAME_RAD, find_angles
from bench.audit.faults.stiffness import DEVIATION

AGAINST_RAD = 0.1
"""Between an answer and the axis the wrong way; rounding bends no answer so."""


def find(examined: Examined) -> Symptom | None:
    """e points against the axis for some pairs, or an angle is more than pi."""
    if not examined.form and abs(examined.slope * np.radians(1.0) - 1.0) < DEVIATION:
        return None  # a sine of degrees, which is not a matter of a wrap
    if examined.convention:
        here = ~examined.at("at-180", "identity", "near-180")
        with np.errstate(invalid="ignore"):
            bad = here & (examined.apart > np.pi - AGAINST_RAD)
            if (here & (examined.apart > AGAINST_RAD)).sum() > 2 * bad.sum():
                return None  # most that leave the axis point anywhere
    elif (angles := find_angles(examined)) is not None:
        here, bad = examined.at("wide"), np.zeros(len(examined.e), dtype=bool)
        off = np.abs(examined.e[here] - angles.values)
        outside = (np.abs(examined.e[here]) > np.pi + SAME_RAD) & (np.minimum(off, np.abs(off - 2 * np.pi)) < SAME_RAD)
        bad[here] = outside.any(axis=1)
    else:
        return None
    what = "e points against the axis" if examined.convention else "an angle is more than 180°"
    return examined.first(bad, f"{what} for {bad.sum()} of {here.sum()} pairs")
