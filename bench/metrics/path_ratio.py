"""How far the body turned, over how far it had to: 1 is the geodesic, more is a detour or unwinding."""

import math

from bench.metric import Metric
from bench.scalar import kernel, sqrt
from bench.so3 import dot


@kernel
def update(value, sample):
    """Travelled angle: the sum of |omega| dt."""
    return value + sqrt(dot(sample.omega, sample.omega)) * sample.dt


def finish(value, ending):
    """Travelled over initial angle; no number where the episode starts at the goal."""
    return value / ending.angle0 if ending.angle0 > 0.0 else math.nan


METRIC = Metric("path-ratio", "path_ratio", "1", "travelled angle over initial angle", 0.0, update, finish)
