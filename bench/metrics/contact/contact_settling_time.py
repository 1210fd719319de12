"""How long after the first touch the hand exerts the force that it was ordered to, and goes on doing so."""

import numpy as np

from bench.metrics.contact_force import force_error, from_first_touch, last
from bench.metrics.contact_metric import ContactMetric, Pose
from tasks.rules import RULES


def measure(pose: Pose) -> float:
    """Time [s] from the first touch until |f + h| stays within 2 % of |h|, the band of all settling times here.

    NaN if it does not, if no force was ordered, or if nothing was touched.
    """
    one, touched = last(pose), from_first_touch(pose)
    ordered = np.linalg.norm(pose.first.trial.order.exerts[:3])
    if one is None or touched is None or ordered == 0.0:
        return np.nan
    outside = np.flatnonzero(np.linalg.norm(force_error(pose), axis=1) > RULES.tolerance * ordered)
    settled = outside[-1] + 1 if outside.size else 0
    time = one.time[touched]
    return float(time[settled] - time[0]) if settled < len(time) else np.nan


METRIC = ContactMetric(
    "contact-settling-time", "contact_settling_time_s", "s", "settling time of the force, from the first touch", measure
)
