"""The path of the body: how far it turns, and how near it comes to a singularity."""

import math

from bench.engines.metrics.metric import Metric, if_finite
from bench.law import dot, kernel, sqrt


@kernel
def smallest_margin(value, sample):
    """Smallest margin; a law on R has none (NaN), which changes nothing."""
    return min(value, sample.margin)


@kernel
def travel(value, sample):
    """Travelled angle: the sum of |omega| dt."""
    return value + sqrt(dot(sample.omega, sample.omega)) * sample.dt


def over_initial(value, ending):
    """Travelled over initial angle: 1 is the geodesic; no number where the episode starts at the goal."""
    return value / ending.angle0 if ending.angle0 > 0.0 else math.nan


METRICS = (
    Metric("min_margin", "1", "smallest distance to the singular set", math.inf, smallest_margin, if_finite),
    Metric("path_ratio", "1", "travelled angle over initial angle", 0.0, travel, over_initial),
)
