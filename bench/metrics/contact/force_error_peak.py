"""How far the force that the hand exerts is from the one ordered, along the axes that comply: the largest."""

from bench.metrics.contact_force import force_error, peak
from bench.metrics.contact_metric import ContactMetric, Pose


def measure(pose: Pose) -> float:
    """max |f + h| [N] from the first touch on; NaN without touch, or if no axis complies."""
    return peak(force_error(pose))


METRIC = ContactMetric("force-error-peak", "force_error_peak_n", "N", "error of the force exerted, largest", measure)
