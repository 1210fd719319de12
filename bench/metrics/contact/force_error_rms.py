"""How far the force that the hand exerts is from the one ordered, along the axes that comply: root mean square."""

from bench.metrics.contact_force import force_error, rms
from bench.metrics.contact_metric import ContactMetric, Pose


def measure(pose: Pose) -> float:
    """Root mean square of |f + h| [N] from the first touch on; NaN without touch, or if no axis complies."""
    return rms(force_error(pose))


METRIC = ContactMetric("force-error-rms", "force_error_rms_n", "N", "error of the force exerted, rms", measure)
