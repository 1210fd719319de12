"""the length of the error is wrong for some pairs of orientations.

effect: the stiffness depends on the orientation, and may jump from one orientation to the next
cure: compute the length of the error only from the angle between the two orientations
unless: norm-clip, axis-clip, deadband, jump, long-way, misaligned, euler-angles, single-precision, digits-near-0,
  digits-near-180, memory
"""

import numpy as np

from bench.audit.examined import Examined, Symptom
from bench.audit.pairs import at_angles

DEVIATION = 1e-3
"""Share of the size that the form has: single precision leaves 1e-6."""
OTHERS, SEED = 12, 5
"""Pairs of the same angle as another."""
SMALLEST_RAD = 1e-4
"""Digits may be lost at smaller angles."""


def find(examined: Examined) -> Symptom | None:
    """Find pairs whose answer has the right axis and the wrong length."""
    if not examined.form:
        return None
    right = np.linalg.norm(examined.truth, axis=1)
    here = ~examined.at("at-180", "identity", "near-180") & (examined.pairs.angle > SMALLEST_RAD)
    with np.errstate(invalid="ignore", divide="ignore"):
        ratio = examined.size / right
        bad = here & (np.abs(ratio - 1.0) > DEVIATION)
    if not bad.any() or depends_on_angle(examined, np.flatnonzero(bad)):
        return None
    low, high = f"{np.nanmin(ratio[bad]):.3g}", f"{np.nanmax(ratio[bad]):.3g}"
    times = low if low == high else f"{low} to {high}"
    text = f"for {bad.sum()} of {here.sum()} pairs |e| is {times} times what it is for others of the same angle"
    return Symptom(text, examined.evidence(int(np.argmax(bad))))


def depends_on_angle(examined: Examined, bad: np.ndarray) -> bool:
    """Tell whether some pairs have the size of others of the same angle, about other axes: a size of its own."""
    some = np.repeat(bad[:: 1 + len(bad) // 12], OTHERS)
    others = at_angles("line", np.random.default_rng(SEED), examined.pairs.angle[some])
    size = np.linalg.norm(examined.evaluate(others).e, axis=1)
    return bool(np.all(np.abs(size - examined.size[some]) <= DEVIATION * examined.size[some]))
