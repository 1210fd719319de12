"""How deep the peg is in the hole in the end."""

import numpy as np

from bench.metrics.contact_force import insertion
from bench.metrics.contact_metric import ContactMetric, Pose


def measure(pose: Pose) -> float:
    """Depth [m] of the middle of the peg's lower face below the mouth, along the hole's axis; at least 0."""
    depth = insertion(pose)
    return float(max(depth[-1], 0.0)) if depth is not None else np.nan


METRIC = ContactMetric("insertion-depth", "insertion_depth_m", "m", "depth of the peg in the hole at the end", measure)
