"""Largest torque of any joint."""

import math

from bench.law.scalar import kernel
from bench.metrics.metric import Metric


@kernel
def update(value, sample):
    """max tau_i^2; a torque that is not a number changes nothing."""
    for i in range(7):
        squared = sample.tau[i] * sample.tau[i]
        if squared > value:
            value = squared
    return value


def finish(value, ending):
    """max |tau_i|."""
    return math.sqrt(value)


METRIC = Metric("peak-tau", "peak_tau_nm", "N m", "largest torque of any joint", 0.0, update, finish, True)
