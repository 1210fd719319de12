"""Single precision inside."""

import numpy as np

from bench.audit.fault import Fault, Found
from bench.audit.pairs import CLOSE, WIDE

LEAST, MOST = 1e-9, 1e-4
"""Of the size, where double precision has 1e-16 and single precision 6e-8 times a few operations."""


def find(examined) -> Found | None:
    """Errors of single precision's size where nothing is difficult."""
    here = np.flatnonzero(examined.at(WIDE, CLOSE))
    with np.errstate(invalid="ignore"):
        relative = examined.error[here] / np.linalg.norm(examined.truth[here], axis=1)
        fits = relative < MOST
        if fits.sum() < len(here) / 5 or np.median(relative[fits]) < LEAST:
            return None
    i = int(here[np.flatnonzero(fits)[np.argmax(relative[fits])]])
    return Found(f"answers are off by {np.median(relative[fits]):.1g} of their size everywhere", examined.evidence(i))


FAULT = Fault(
    "single-precision",
    "single precision inside",
    "steps of 1e-7 rad in the error, which a derivative or high damping makes audible",
    "compute the difference of two orientations in double precision; what follows may be single",
    "rotation-vector",
    find,
)
