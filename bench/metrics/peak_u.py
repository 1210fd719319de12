"""Largest command of the episode."""

import math

from bench.metric import Metric
from bench.scalar import kernel
from bench.so3 import dot


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
