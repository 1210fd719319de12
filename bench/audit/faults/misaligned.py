"""not along the axis.

effect: the robot takes a detour, or does not come to the goal
cure: begin with R_d R^T or q_d q*, and take its axis
unless: quaternion-order, transpose, frame, euler-angles, raises, not-a-number, axis-clip, long-way, deadband, jump,
  memory
"""

import numpy as np

from bench.audit.examined import Examined, Found

BENT_RAD = 1e-3
"""Angle to the axis: half a thousandth of it is what single precision leaves nowhere in these places."""


def find(examined: Examined) -> Found | None:
    """Away from 0 and 180° answers leave the axis."""
    here = np.flatnonzero(examined.at("wide", "close"))
    if not examined.convention:
        return Found("nothing known explains its answers: they lie along no axis", examined.evidence(int(here[0])))
    angle = np.nan_to_num(examined.apart[here])
    bent = int((angle > BENT_RAD).sum())
    if not bent:
        return None
    worst = int(np.argmax(angle))
    text = f"{bent} of {len(here)} answers are off the axis, by up to {np.degrees(angle[worst]):.3g}°"
    return Found(text, examined.evidence(int(here[worst])))
