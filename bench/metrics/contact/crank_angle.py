"""How far the hand has turned the joint of the scene."""

import numpy as np

from bench.metrics.contact_force import last
from bench.metrics.contact_metric import ContactMetric, Pose


def measure(pose: Pose) -> float:
    """Angle [rad] of the scene's joint at the end, less that at the start; NaN if the scene has no joint."""
    one = last(pose)
    if one is None or not pose.task.surroundings(pose.arm).joint:
        return np.nan
    return float(one.turned[-1] - one.turned[0])


METRIC = ContactMetric("crank-angle", "crank_angle_rad", "rad", "angle that the scene's joint was turned by", measure)
