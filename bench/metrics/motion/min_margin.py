"""How near the episode came to the singular set of the law's representation: 0 is on it."""

import math

from bench.law.scalar import kernel
from bench.metrics.metric import Metric


@kernel
def update(value, sample):
    """Smallest margin; a law on R has none (NaN), which changes nothing."""
    if sample.margin < value:
        return sample.margin
    return value


def finish(value, ending):
    """The margin; no number for a law without a representation."""
    return value if value < math.inf else math.nan


METRIC = Metric("min-margin", "min_margin", "1", "smallest distance to the singular set", math.inf, update, finish)
