"""the function raises an exception.

effect: the control loop stops, or the motors keep the last command
cure: return an orientation error, without an exception, for every pair of orientations
"""

import numpy as np

from bench.audit.examined import Examined, Symptom


def find(examined: Examined) -> Symptom | None:
    """Find calls that raise or that do not return three numbers."""
    silent = np.array([bool(reason) for reason in examined.raised])
    if examined.form == "gibbs":
        silent &= ~examined.at("at-180")  # where its form is infinite
    places = ", ".join(dict.fromkeys(examined.pairs.place[silent]))
    return examined.first(silent, f"no answer for {silent.sum()} of {len(silent)} pairs ({places})")
