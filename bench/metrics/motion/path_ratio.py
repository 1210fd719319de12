"""How far the body turned, over how far it had to: 1 is the geodesic, more is a detour or unwinding."""

import math

from bench.law.scalar import kernel, sqrt
from bench.law.so3 import dot
from bench.metrics.metric import Metric


@kernel
def update(value, sample):
    """Travelled angle: the sum of |omega| dt."""
    return value + sqrt(dot(sample.omega, sample.omega)) * sample.dt


def finish(value, ending):
    """Travelled over initial angle; no number where the episode starts at the goal."""
    return value / ending.angle0 if ending.angle0 > 0.0 else math.nan


METRIC = Metric("path-ratio", "path_ratio", "1", "travelled angle over initial angle", 0.0, update, finish)
