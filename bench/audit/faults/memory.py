"""the function returns different errors for the same pair of orientations, because it has a state or adds noise.

effect: the error depends on earlier calls; the audit tests each pair alone, so the other results of the audit are not
  valid
cure: audit the function without a filter; if the function intentionally remembers the sign of q, allow this fault
law: quaternion-shortest
"""

import numpy as np

from bench.audit.examined import Examined, Symptom, evaluate, inputs

DIFFERENCE = 1e-12
"""Share of slope times a radian; one function of the same numbers has none."""


def find(examined: Examined) -> Symptom | None:
    """Call the function again for some pairs, from 180° to 0, and compare; then one that was loaded afresh.

    "cube" has many goals for each R: a value that is kept for an R, and never computed again, shows there. What keeps
    one of the two signs of a quaternion keeps the other one after -q_d.
    """
    here = np.flatnonzero(examined.at("wide", "cube", "near-identity", "near-180"))[::11]
    here = here[np.argsort(examined.pairs.distance[here], kind="stable")]
    now, goal = inputs(examined.takes, examined.pairs.chosen(here))
    if examined.takes != "matrix":
        evaluate(examined.function, now, -goal)
    first, again = examined.e[here], evaluate(examined.function, now, goal).e
    if examined.fresh and np.array_equal(first, again, equal_nan=True):
        again = evaluate(examined.fresh(), now, goal).e
    differs = np.linalg.norm(again - first, axis=1) > DIFFERENCE * examined.slope
    if not differs.any():
        return None
    text = f"{differs.sum()} of {len(here)} pairs have another answer when they are evaluated again, in another order"
    return Symptom(text, examined.evidence(int(here[np.argmax(differs)])))
