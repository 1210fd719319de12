"""How far the tool strayed from the position it was to hold."""

import math

from bench.law.scalar import kernel
from bench.metrics.metric import Metric


@kernel
def update(value, sample):
    """max |p - p_d|^2."""
    x, y, z = sample.p[0] - sample.p_d[0], sample.p[1] - sample.p_d[1], sample.p[2] - sample.p_d[2]
    squared = x * x + y * y + z * z
    if squared > value:
        return squared
    return value


def finish(value, ending):
    """max |p - p_d|."""
    return math.sqrt(value)


METRIC = Metric(
    "position-error", "position_error_m", "m", "largest distance of the tool from its place", 0.0, update, finish, True
)
