"""How steadily a tip presses on the plane it slides along: the force along the plane's normal against the ordered."""

import numpy as np

from bench.metrics.contact_force import from_first_touch, rms, scene_normal
from bench.metrics.contact_metric import ContactMetric, Pose

SLIDING = "force-on-plane"


def measure(pose: Pose) -> float:
    """Root mean square of n . (f + h) [N] from the first touch on, n the normal of the plane."""
    one, touched = pose.first, from_first_touch(pose)
    if touched is None or pose.task.name != SLIDING:
        return np.nan
    error = (one.force[touched] + np.array(one.trial.order.exerts[:3])) @ scene_normal(one.trial)
    return rms(error[:, None])


METRIC = ContactMetric(
    "normal-force-error", "normal_force_error_n", "N", "error of the force normal to the plane, rms", measure
)
