"""What a closed loop of moments leaves of rotation about the axes that the order holds.

To hold omega_z = 0 holds no angle: a square loop of side a about x and y leaves about a^2 about z.
"""

import numpy as np

from bench.metrics.contact_force import last
from bench.metrics.contact_metric import ContactMetric, Pose
from bench.metrics.measured_compliance import held, turned


def measure(pose: Pose) -> float:
    """Rotation [rad] from start to end about axes that the order holds; NaN unless the pushes come in legs."""
    one = last(pose)
    if one is None or not one.trial.legs:
        return np.nan
    return float(np.linalg.norm(turned(one.R)[held(pose)]))


METRIC = ContactMetric("loop-drift", "loop_drift_rad", "rad", "rotation about held axes left by a closed loop", measure)
