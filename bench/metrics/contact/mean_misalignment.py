"""How far the hand's rotation turns away from the moment that causes it: the mean over the axes that comply."""

import numpy as np

from bench.metrics.contact_metric import ContactMetric, Pose
from bench.metrics.measured_compliance import astray, compliance, complying


def measure(pose: Pose) -> float:
    """The mean angle [rad] between e and C e over the axes e that comply; NaN if a moment turns nothing."""
    angles = astray(compliance(pose), complying(pose))
    return float(angles.mean()) if len(angles) else np.nan


METRIC = ContactMetric(
    "mean-misalignment",
    "mean_misalignment_rad",
    "rad",
    "mean angle between a moment and the rotation it causes",
    measure,
)
