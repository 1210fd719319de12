"""the real stiffness is not the stiffness that the user sets.

effect: the real stiffness is the product of the set stiffness and the slope of the error; the damping ratio is the
  intended ratio divided by sqrt(slope)
cure: divide the error or the stiffness by the slope of the error at the goal
law: quaternion-shortest
unless: euler-angles
"""

import numpy as np

from bench.audit.examined import FAULT, Examined, Symptom

DEVIATION = 1e-3
"""Share of the slope: no gain is set better than to a thousandth."""

LARGEST_RAD = 0.09
"""A pair that reproduces it is larger: no dead band reaches so far."""

LEAST_RAD, MOST_RAD = 1e-6, 1e-2
TIMES = 1.5
"""Between them; a form of one slope changes by 1e-4, and digits lost by less than a tenth."""


UNITS = {
    np.degrees(1.0): ("degrees", "180/pi"),
    1.0 / np.pi: ("half turns", "1/pi"),
    0.5 / np.pi: ("turns", "1/(2 pi)"),
}
FACTORS = {
    ("sine-of-half", 0.5): "multiply by 2: the vector part of a quaternion is sin(θ/2) k",
    ("rotation-vector", 0.5): "multiply by 2: the angle of a quaternion is 2 atan2(|v|, w)",
    ("gibbs", 0.5): "multiply by 2: Rodrigues parameters are tan(θ/2) k",
    ("mrp", 0.25): "multiply by 4: modified Rodrigues parameters are tan(θ/4) k",
    ("sine", 2.0): "divide by 2: the sum of the three cross products, as R - R^T, is 2 sin θ k",
}
"""Cures of slopes that have a reason."""


def find(examined: Examined) -> Symptom | None:
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
            return Symptom(
                text, examined.evidence(int(np.flatnonzero(here)[np.argmax(felt)]), False)
            )
        if abs(examined.slope / examined.stated.stiffness - 1.0) < felt.max() / felt.min() - 1.0:
            return None  # no one slope: another fault
    ratio = examined.slope / examined.stated.stiffness
    i = int(np.flatnonzero(examined.at("near-identity") & (examined.pairs.angle > LARGEST_RAD))[0])
    evidence = examined.evidence(i, False)._replace(right=examined.e[i] / ratio)
    effect = f"the stiffness is {ratio:.4g} times, and the damping ratio {ratio**-0.5:.2g} times the value that is set"
    for slope, (unit, words) in UNITS.items():
        if abs(ratio / slope - 1.0) <= DEVIATION:
            cure = "convert to radians" + (": np.radians(e)" if unit == "degrees" else "") * bool(examined.form)
            return Symptom(
                f"e is in {unit}: the slope is {ratio:.6g} = {words}", evidence, FAULT, effect, cure
            )
    cures = (
        cure for (form, slope), cure in FACTORS.items() if form == examined.form and abs(ratio / slope - 1.0) < 1e-6
    )
    words = f"the real stiffness is {ratio:.4g} of the stiffness that is set"
    return Symptom(words, evidence, FAULT, effect, next(cures, ""))
