"""What leaks into the axes that are held: rotation about them over rotation about those that comply, at the worst.

With Z-Y-X angles and compliance about x and y the moment about x leaks tan(beta) into z.
"""

import numpy as np

from bench.metrics.contact_metric import ContactMetric, Pose
from bench.metrics.measured_compliance import compliance, complying, is_still


def measure(pose: Pose) -> float:
    """The largest ratio |(C e) held| / |(C e) complying| over the axes e that comply; NaN if all do, or none."""
    complies = complying(pose)
    yields = compliance(pose)[:, complies]
    if complies.all() or not complies.any() or is_still(yields).any():
        return np.nan
    held, freed = np.linalg.norm(yields[~complies], axis=0), np.linalg.norm(yields[complies], axis=0)
    return float(np.divide(held, freed, out=np.full_like(held, np.inf), where=freed != 0.0).max())


METRIC = ContactMetric(
    "leakage", "leakage_ratio", "1", "rotation about held axes over that about complying ones", measure
)
