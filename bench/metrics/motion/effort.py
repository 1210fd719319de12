"""Control effort: the time integral of the squared command."""

from bench.law.scalar import kernel
from bench.law.so3 import dot
from bench.metrics.metric import Metric


@kernel
def update(value, sample):
    """Sum of |u|^2 dt."""
    return value + dot(sample.u, sample.u) * sample.dt


def finish(value, ending):
    """The sum."""
    return value


METRIC = Metric("effort", "effort", "rad^2/s^3", "integral of the squared command", 0.0, update, finish)
