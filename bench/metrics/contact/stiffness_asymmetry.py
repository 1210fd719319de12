"""How far the hand's rotational stiffness is from that of springs, which is symmetric."""

import numpy as np

from bench.metrics.contact_metric import ContactMetric, Pose
from bench.metrics.measured_compliance import among_complying


def measure(pose: Pose) -> float:
    """|C - C^T| / |C + C^T|, Frobenius, among the axes that comply; NaN for less than two of them."""
    yields = among_complying(pose)
    if len(yields) < 2:
        return np.nan
    return float(np.linalg.norm(yields - yields.T) / np.linalg.norm(yields + yields.T))


METRIC = ContactMetric(
    "stiffness-asymmetry", "stiffness_asymmetry", "1", "skew over symmetric part of the rotational stiffness", measure
)
