"""The largest moment on the hand, whatever its direction."""

import numpy as np

from bench.metrics.contact_metric import ContactMetric, Pose


def measure(pose: Pose) -> float:
    """max |m| over all ticks [N m]; NaN if nothing was recorded."""
    sizes = np.concatenate([np.linalg.norm(one.moment, axis=1) for one in pose.responses])
    return float(np.fmax.reduce(sizes, initial=np.nan))


METRIC = ContactMetric("peak-moment", "peak_moment_nm", "N m", "largest moment on the hand", measure)
