"""How far the moment that the hand exerts is from the one ordered, about the axes that comply: root mean square."""

from bench.metrics.contact_force import moment_error, rms
from bench.metrics.contact_metric import ContactMetric, Pose


def measure(pose: Pose) -> float:
    """Root mean square of |m + h| [N m] from the first touch on; NaN without touch, or if no axis complies."""
    return rms(moment_error(pose))


METRIC = ContactMetric("moment-error-rms", "moment_error_rms_nm", "N m", "error of the moment exerted, rms", measure)
