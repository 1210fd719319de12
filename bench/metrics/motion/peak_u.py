"""Largest command of the episode."""

import math

from bench.law.scalar import kernel
from bench.law.so3 import dot
from bench.metrics.metric import Metric


@kernel
def update(value, sample):
    """max |u|^2; a command that is not a number changes nothing."""
    squared = dot(sample.u, sample.u)
    if squared > value:
        return squared
    return value


def finish(value, ending):
    """max |u|."""
    return math.sqrt(value)


METRIC = Metric("peak-u", "peak_u", "rad/s^2", "largest commanded angular acceleration", 0.0, update, finish)
