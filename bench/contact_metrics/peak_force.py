"""The largest force on the hand, whatever its direction."""

import numpy as np

from bench.contact_metric import ContactMetric, Pose


def measure(pose: Pose) -> float:
    """max |f| over all ticks [N]; NaN if nothing was recorded."""
    sizes = [np.linalg.norm(one.force, axis=1).max(initial=np.nan) for one in pose.responses]
    return float(np.max(sizes))


METRIC = ContactMetric("peak-force", "peak_force_n", "N", "largest force on the hand", measure)
