"""The moment to which the hand yields least, of all those about axes that comply: 0 means that it is lost."""

import numpy as np

from bench.metrics.contact_metric import ContactMetric, Pose
from bench.metrics.measured_compliance import compliance, complying


def measure(pose: Pose) -> float:
    """min |C m| / |m| [rad/(N m)] over the moments m in the span of the axes that comply."""
    yields = compliance(pose)[:, complying(pose)]
    return float(np.linalg.svd(yields, compute_uv=False)[-1]) if yields.size and np.isfinite(yields).all() else np.nan


METRIC = ContactMetric(
    "least-yield", "least_yield_rad_per_nm", "rad/(N m)", "least rotation per moment about complying axes", measure
)
