"""How much was commanded: the largest command and the integral of its square."""

from bench.law import dot, kernel
from bench.metrics.metric import Metric, as_it_is, root


@kernel
def add_square(value, sample):
    """Sum of |u|^2 dt."""
    return value + dot(sample.u, sample.u) * sample.dt


@kernel
def largest_square(value, sample):
    """max |u|^2; a command that is not a number changes nothing."""
    squared = dot(sample.u, sample.u)
    if squared > value:
        return squared
    return value


METRICS = (
    Metric("effort", "effort", "rad^2/s^3", "integral of the squared command", 0.0, add_square, as_it_is),
    Metric("peak-u", "peak_u", "rad/s^2", "largest commanded angular acceleration", 0.0, largest_square, root),
)
