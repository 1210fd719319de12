"""What a closed loop of moments leaves of rotation in all."""

import numpy as np

from bench.metrics.contact_force import last
from bench.metrics.contact_metric import ContactMetric, Pose
from bench.metrics.measured_compliance import turned


def measure(pose: Pose) -> float:
    """Angle [rad] of the rotation from start to end; NaN unless the pushes come in legs."""
    one = last(pose)
    return float(np.linalg.norm(turned(one.R))) if one is not None and one.trial.legs else np.nan


METRIC = ContactMetric("loop-rest", "loop_rest_rad", "rad", "rotation left by a closed loop", measure)
