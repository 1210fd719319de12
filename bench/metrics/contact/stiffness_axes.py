"""Whether the hand's rotational stiffness has the axes that were asked for: its principal axes against those.

An isotropic stiffness has every axis as a principal one, and the angle is 0. With Z-Y-X angles it is 45 degrees less
half of |beta| from the first bit of beta on, however little the stiffness then differs from axis to axis.
"""

import numpy as np

from bench.metrics.contact_metric import ContactMetric, Pose
from bench.metrics.measured_compliance import among_complying

# Relative gap between principal values of C up to which they count as one: what the moments' own size, some
# milliradians of rotation, may change C by, and a fifteenth of what Z-Y-X angles make of one degree of beta.
ALIKE = 1e-3


def measure(pose: Pose) -> float:
    """The largest angle [rad] of an axis that complies to the nearest principal axis (or plane) of (C + C^T)/2."""
    yields = among_complying(pose)
    if len(yields) < 2 or not np.isfinite(yields).all():
        return np.nan
    values, axes = np.linalg.eigh(0.5 * (yields + yields.T))
    apart = np.flatnonzero(np.diff(values) > ALIKE * np.abs(values).max()) + 1
    shares = [np.linalg.norm(space, axis=1) for space in np.split(axes, apart, axis=1)]
    return float(np.arccos(np.clip(np.max(shares, axis=0), 0.0, 1.0)).max())


METRIC = ContactMetric(
    "stiffness-axes", "stiffness_axes_rad", "rad", "largest angle of an axis asked for to a principal one", measure
)
