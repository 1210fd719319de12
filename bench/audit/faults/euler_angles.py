"""Euler angles for an axis.

effect: the robot takes a detour that depends on the orientation, and at the pole turns by any amount for none
cure: take an error along the axis, or map the angles' rates to angular velocity, and stay off the pole
unless: quaternion-order, transpose, frame
"""

import numpy as np

from bench.audit.euler import find_angles
from bench.audit.examined import Examined
from bench.audit.fault import Found
from bench.audit.pairs import WIDE


def find(examined: Examined) -> Found | None:
    """Three angles, or differences of them, about axes that are not at right angles."""
    angles = find_angles(examined)
    if angles is None:
        return None
    here = np.flatnonzero(examined.at(WIDE))
    worst = int(here[np.argmax(np.abs(examined.e[here]).max(axis=1))])
    text = f"e is {angles.how} (intrinsic {angles.sequence}): no axis, and a pole where the middle angle is 90°"
    return Found(text, examined.evidence(worst, False))
