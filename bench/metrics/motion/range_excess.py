"""How far a joint went beyond its range, which the plant does not enforce."""

import math

from bench.law.scalar import kernel
from bench.metrics.metric import Metric


@kernel
def update(value, sample):
    """max over joints of q - upper or lower - q [rad], if positive."""
    for i in range(7):
        above, below = sample.q[i] - sample.upper[i], sample.lower[i] - sample.q[i]
        if above > value:
            value = above
        if below > value:
            value = below
    return value


def finish(value, ending):
    """The excess; no number once the joints' angles are none."""
    return value if value < math.inf else math.nan


METRIC = Metric(
    "range-excess", "range_excess_rad", "rad", "largest excess of a joint over its range", 0.0, update, finish, True
)
