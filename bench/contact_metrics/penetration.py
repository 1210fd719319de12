"""How deep hand and scene are in each other at the worst: what the contact model gives way."""

import numpy as np

from bench.contact_metric import ContactMetric, Pose


def measure(pose: Pose) -> float:
    """max(0, -gap) [m] over all ticks; NaN if there is no scene."""
    if not pose.task.surroundings(pose.arm).scene:
        return np.nan
    depths = np.concatenate([-one.gap for one in pose.responses])
    return float(np.fmax(np.fmax.reduce(depths, initial=np.nan), 0.0)) if len(depths) else np.nan


METRIC = ContactMetric("penetration", "penetration_m", "m", "deepest penetration of hand and scene", measure)
