"""How far a body is from its goal at the farthest: what shows that it first turned away. It is no column of a run."""

from bench.engines.metrics.metric import Metric, as_it_is
from bench.law import kernel


@kernel
def largest_haversine(value, sample):
    """Largest haversine of the angle to the goal."""
    return max(value, sample.haversine)


FARTHEST = Metric("farthest", "1", "largest haversine of the angle to the goal", 0.0, largest_haversine, as_it_is)
