"""stiffness felt is not stiffness set.

effect: the stiffness felt is the slope times that set, and the damping ratio changes by one over the slope's root
cure: take radians; a vector part needs the factor 2, modified Rodrigues parameters 4; or divide the gain by the slope
law: quaternion-shortest
unless: euler-angles
"""

import numpy as np

from bench.audit.examined import FAULT, Examined, Found

DEVIATION = 1e-3
"""Share of the slope: no gain is set better than to a thousandth."""

LARGEST_RAD = 0.09
"""A pair that reproduces it is larger: no dead band reaches so far."""

LEAST_RAD, MOST_RAD = 1e-6, 1e-2
TIMES = 1.5
"""Between them; a form of one slope changes by 1e-4, and digits lost by less than a tenth."""


RADIANS = "convert it to radians: np.radians(e)"


def find(examined: Examined) -> Found | None:
    """|e|/theta at the goal is not what was stated."""
    if not examined.convention or abs(examined.slope / examined.stated.stiffness - 1.0) <= DEVIATION:
        return None
    if not examined.form:
        here = examined.at("near-identity") & (examined.pairs.angle >= LEAST_RAD) & (examined.pairs.angle <= MOST_RAD)
        felt = examined.size[here] / examined.pairs.angle[here]
        if not felt.all():
            return None  # a dead band: there is no slope to speak of
        if felt.max() > TIMES * felt.min():
            text = f"|e|/theta is between {felt.min():.4g} and {felt.max():.4g} near the goal: no gain is set by it"
            return Found(text, examined.evidence(int(np.flatnonzero(here)[np.argmax(felt)]), False))
    ratio = examined.slope / examined.stated.stiffness
    i = int(np.flatnonzero(examined.at("near-identity") & (examined.pairs.angle > LARGEST_RAD))[0])
    evidence = examined.evidence(i, False)._replace(right=examined.e[i] / ratio)
    effect = f"the robot is {ratio:.4g} times as stiff as set, and damped {ratio**-0.5:.2g} times as much for it"
    if abs(ratio * np.radians(1.0) - 1.0) <= DEVIATION:
        return Found(f"e is in degrees: the slope is {ratio:.6g} = 180/pi", evidence, FAULT, effect, RADIANS)
    return Found(f"the stiffness felt is {ratio:.4g} of the stiffness set", evidence, FAULT, effect)
