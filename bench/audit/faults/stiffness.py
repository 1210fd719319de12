"""Another slope at the goal than the gains reckon with."""

import numpy as np

from bench.audit.fault import Fault, Found
from bench.audit.pairs import NEAR_IDENTITY

DEVIATION = 1e-3
"""Of the slope: no gain is set better than to a thousandth."""

LARGEST_RAD = 0.09
"""What is shown to reproduce is larger: no dead band reaches so far."""


def find(examined) -> Found | None:
    """|e|/theta at the goal is not what was stated."""
    if not examined.convention or abs(examined.slope / examined.stated.stiffness - 1.0) <= DEVIATION:
        return None
    ratio = examined.slope / examined.stated.stiffness
    i = int(np.flatnonzero(examined.at(NEAR_IDENTITY) & (examined.pairs.angle > LARGEST_RAD))[0])
    evidence = examined.evidence(i, False)._replace(right=examined.e[i] / ratio)
    return Found(f"the stiffness felt is {ratio:.4g} of the stiffness set", evidence)


FAULT = Fault(
    "stiffness",
    "stiffness felt is not stiffness set",
    "with half the slope the robot is half as stiff as set, and damped 1.4 times as much as critically",
    "a vector part needs the factor 2, modified Rodrigues parameters 4; or reckon with it in the gain",
    "quaternion-shortest",
    find,
    unless=("euler-angles", "deadband"),
)
