"""the error differs between the goals q and -q, which are the same orientation.

effect: the robot turns by up to 360°, and tumbles if the sign of the quaternion changes in a stream of goals
cure: change the sign of the error quaternion if its scalar part is negative
law: quaternion-shortest
"""

import numpy as np

from bench.audit.examined import Examined, PairEvidence, Symptom, evaluate, inputs

OTHERWISE = 1e-3
"""Least difference of angles; rounding leaves 1e-16, single precision 1e-7."""
SMALLEST_RAD = 1e-3


def find(examined: Examined) -> Symptom | None:
    """f(q, -q_d) and f(-q, q_d) are not f(q, q_d)."""
    if examined.takes == "matrix" or not examined.convention:
        return None
    here = np.flatnonzero(examined.at("wide", "identity"))[::4]
    now, goal = inputs(examined.takes, examined.pairs.chosen(here))
    for other, given in (("-q_d", (now, -goal)), ("-q", (-now, goal))):
        said = evaluate(examined.function, *given).e
        apart = np.linalg.norm(said - examined.e[here], axis=1)
        same = apart <= OTHERWISE * examined.slope * np.fmax(examined.pairs.angle[here], SMALLEST_RAD)
        bad = ~same & np.isfinite(examined.size[here])
        if bad.any():
            i = int(np.argmax(bad))
            text = f"{bad.sum()} of {len(here)} pairs are answered otherwise with {other}, the same orientation"
            return Symptom(
                text, PairEvidence(given[0][i], given[1][i], said[i], examined.e[here[i]])
            )
    return None
