"""Largest torque over what its motor is rated for: above 1, a real arm could not have done it."""

import math

from bench.law.scalar import kernel
from bench.metrics.metric import Metric


@kernel
def update(value, sample):
    """max (tau_i / rated_i)^2; a torque that is not a number changes nothing."""
    for i in range(7):
        ratio = sample.tau[i] / sample.rated[i]
        if ratio * ratio > value:
            value = ratio * ratio
    return value


def finish(value, ending):
    """max |tau_i| / rated_i."""
    return math.sqrt(value)


METRIC = Metric(
    "peak-torque-ratio",
    "peak_torque_ratio",
    "1",
    "largest torque over the motor's rated one",
    0.0,
    update,
    finish,
    True,
)
