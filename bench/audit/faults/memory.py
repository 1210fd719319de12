"""state, or noise: the same pair has two answers.

effect: the error depends on what came before; this audit asks each pair for itself, and is void
cure: audit the function without its filter; hysteresis between the two signs of q may be meant, and accepted
law: quaternion-shortest
"""

import numpy as np

from bench.audit.examined import Examined, Found, evaluate, inputs

DIFFERENCE = 1e-12
"""Share of slope times a radian; one function of the same numbers has none."""


def find(examined: Examined) -> Found | None:
    """Call the function again for some pairs, in reverse order, and compare; then one that was loaded afresh.

    "cube" has many goals for each R: a value that is kept for an R, and never computed again, shows there.
    """
    here = np.flatnonzero(examined.at("wide", "cube"))[::-10]
    first, again = examined.e[here], examined.evaluate(examined.pairs.chosen(here)).e
    if examined.fresh and np.array_equal(first, again, equal_nan=True):
        again = evaluate(examined.fresh(), *inputs(examined.takes, examined.pairs.chosen(here))).e
    differs = np.linalg.norm(again - first, axis=1) > DIFFERENCE * examined.slope
    if not differs.any():
        return None
    text = f"{differs.sum()} of {len(here)} pairs have another answer when they are evaluated again, in reverse order"
    return Found(text, examined.evidence(int(here[np.argmax(differs)])))
