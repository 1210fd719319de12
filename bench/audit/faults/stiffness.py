"""Another slope at the goal than the gains reckon with."""

import numpy as np

from bench.audit.fault import Fault, Found
from bench.audit.pairs import NEAR_IDENTITY

DEVIATION = 1e-3
"""Of the slope: no gain is set better than to a thousandth."""

LARGEST_RAD = 0.09
"""What is shown to reproduce is larger: no dead band reaches so far."""

LEAST_RAD, MOST_RAD = 1e-6, 1e-2
TIMES = 1.5
"""Between them; a form of one slope changes by 1e-4, and digits lost by less than a tenth."""


def find(examined) -> Found | None:
    """|e|/theta at the goal is not what was stated."""
    if not examined.convention or abs(examined.slope / examined.stated.stiffness - 1.0) <= DEVIATION:
        return None
    if not examined.convention.form:
        here = examined.at(NEAR_IDENTITY) & (examined.pairs.angle >= LEAST_RAD) & (examined.pairs.angle <= MOST_RAD)
        felt = examined.size[here] / examined.pairs.angle[here]
        if not felt.all():
            return None  # a dead band: there is no slope to speak of
        if felt.max() > TIMES * felt.min():
            text = f"|e|/theta is between {felt.min():.4g} and {felt.max():.4g} near the goal: no gain is set by it"
            return Found(text, examined.evidence(int(np.flatnonzero(here)[np.argmax(felt)]), False))
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
    unless=("euler-angles",),
)
