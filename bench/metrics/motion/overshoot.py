"""How far the body came out of the settling band again after it had once been inside."""

import math

from bench.law.scalar import kernel
from bench.metrics.metric import Metric


@kernel
def update(value, sample):
    """Largest haversine since the band was first entered."""
    if sample.entered and sample.haversine > value:
        return sample.haversine
    return value


def finish(value, ending):
    """The angle, if it lies outside the band; else 0."""
    angle = 2.0 * math.asin(min(1.0, math.sqrt(value)))
    return angle if angle > ending.band else 0.0


METRIC = Metric(
    "overshoot", "overshoot_rad", "rad", "largest angle after the band was first entered", 0.0, update, finish
)
