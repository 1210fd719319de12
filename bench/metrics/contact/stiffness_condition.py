"""How unlike the hand's rotational stiffness is in different directions: the condition number of C where it complies.

The stiffness C^-1 has the same. With Z-Y-X angles kp I becomes kp B^-T B^-1, whose condition number is
(1 + |sin(beta)|)/(1 - |sin(beta)|).
"""

import numpy as np

from bench.metrics.contact_metric import ContactMetric, Pose
from bench.metrics.measured_compliance import among_complying


def measure(pose: Pose) -> float:
    """Largest over smallest singular value of C among the axes that comply; NaN for less than two of them."""
    yields = among_complying(pose)
    return float(np.linalg.cond(yields)) if len(yields) > 1 and np.isfinite(yields).all() else np.nan


METRIC = ContactMetric(
    "stiffness-condition", "stiffness_condition", "1", "condition number of the rotational stiffness", measure
)
