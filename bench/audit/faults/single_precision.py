"""the function computes in single precision.

effect: the error changes in steps of 1e-7 rad; a derivative or high damping turns these steps into audible noise
cure: compute the difference of two orientations in double precision; later steps may use single precision
"""

import numpy as np

from bench.audit.examined import FAULT, Examined, Symptom
from bench.audit.faults.deadband import find_step

LEAST, MOST = 1e-9, 1e-4
"""Across the axis, of the size, where double precision has 1e-16 and single precision 6e-8 times a few operations.

Along it a small constant in a denominator leaves as much. Half precision leaves a tenth of MOST and more.
"""

SINGLE, LESS = 1e-6, 5.0
"""Nearer the goal, where e is a thirtieth, an error of the orientations is that many times more of e."""


def find(examined: Examined) -> Symptom | None:
    """Off the axis by as much as single precision leaves where nothing is difficult."""
    here = np.flatnonzero(examined.at("wide", "close"))
    across = np.sin(examined.apart[here])
    fits = across < MOST
    if not examined.convention or fits.sum() < len(here) / 5 or np.median(across[fits]) < LEAST or find_step(examined):
        return None
    off = np.median(across[fits])
    if off < SINGLE and np.nanmedian(np.sin(examined.apart[examined.at("fine")])) < LESS * off:
        return None  # only the three numbers are rounded: to a share of their size
    i = int(here[np.flatnonzero(fits)[np.argmax(across[fits])]])
    text = f"answers are off by {off:.1g} of their size everywhere{', as in half precision' if off > MOST / 10 else ''}"
    effect = f"steps of {off:.1g} of the error, which a derivative or high damping makes audible"
    return Symptom(text, examined.evidence(i), FAULT, effect)
