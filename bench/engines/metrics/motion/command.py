"""How much was commanded: the largest command, the integral of its square, and how it changes at rest."""

import math

from bench.engines.metrics.metric import Metric, as_it_is, root
from bench.law import dot, kernel, minus


@kernel
def add_square(value, sample):
    """Sum of |u|^2 dt."""
    return value + dot(sample.u, sample.u) * sample.dt


@kernel
def largest_square(value, sample):
    """max |u|^2; a command that is not a number changes nothing."""
    return max(value, dot(sample.u, sample.u))


@kernel
def largest_change(value, sample):
    """max |u - u before|^2 since the body is at rest for good."""
    if not sample.at_rest:
        return 0.0
    change = minus(sample.u, sample.before)
    return max(value, dot(change, change))


def if_settled(value, ending):
    """Return the root; no number where the body does not come to rest."""
    return math.sqrt(value) if ending.outcome == "settled" else math.nan


METRICS = (
    Metric("effort", "rad^2/s^3", "integral of the squared command", 0.0, add_square, as_it_is),
    Metric("peak_u", "rad/s^2", "largest commanded angular acceleration", 0.0, largest_square, root),
    Metric(
        "rest_change",
        "rad/s^2",
        "largest change of the command from tick to tick at rest",
        0.0,
        largest_change,
        if_settled,
    ),
)
