"""How far the moment that the hand exerts is from the one ordered, about the axes that comply: the largest."""

from bench.metrics.contact_force import moment_error, peak
from bench.metrics.contact_metric import ContactMetric, Pose


def measure(pose: Pose) -> float:
    """max |m + h| [N m] from the first touch on; NaN without touch, or if no axis complies."""
    return peak(moment_error(pose))


METRIC = ContactMetric(
    "moment-error-peak", "moment_error_peak_nm", "N m", "error of the moment exerted, largest", measure
)
