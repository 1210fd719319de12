"""How deep hand and scene are in each other at the worst: what the contact model gives way."""

import numpy as np

from bench.metrics.contact_metric import ContactMetric, Pose


def measure(pose: Pose) -> float:
    """max -gap [m] over all ticks; NaN if they never touched."""
    nearest = float(np.fmin.reduce(np.concatenate([one.gap for one in pose.responses]), initial=np.nan))
    return -nearest if nearest < 0.0 else np.nan


METRIC = ContactMetric("penetration", "penetration_m", "m", "deepest penetration of hand and scene", measure)
