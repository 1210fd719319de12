"""How far the hand's rotation turns away from the moment that causes it: the worst of the axes that comply.

A moment about e turns the hand by C e (`measured_compliance`); this is the largest angle between the two. A hand that
does what it was told turns about the moment, and the angle is 0.
"""

import numpy as np

from bench.metrics.contact_metric import ContactMetric, Pose
from bench.metrics.measured_compliance import astray, compliance, complying


def measure(pose: Pose) -> float:
    """The largest angle [rad] between e and C e over the axes e that comply; NaN if a moment turns nothing."""
    angles = astray(compliance(pose), complying(pose))
    return float(angles.max()) if len(angles) else np.nan


METRIC = ContactMetric(
    "misalignment", "misalignment_rad", "rad", "largest angle between a moment and the rotation it causes", measure
)
