"""The largest force on the hand, whatever its direction."""

import numpy as np

from bench.metrics.contact_metric import ContactMetric, Pose


def measure(pose: Pose) -> float:
    """max |f| over all ticks [N]; NaN if nothing was recorded."""
    sizes = np.concatenate([np.linalg.norm(one.force, axis=1) for one in pose.responses])
    return float(np.fmax.reduce(sizes, initial=np.nan))


METRIC = ContactMetric("peak-force", "peak_force_n", "N", "largest force on the hand", measure)
