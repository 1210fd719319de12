"""The hand's rotational stiffness, by the compliance C that known moments show (`measured_compliance`).

A moment about e turns the hand by C e. A hand that follows its setpoint turns about the moment, alike about every axis
that complies, and as springs do: C = c I. With Z-Y-X angles kp I becomes kp B^-T B^-1.
"""

from collections.abc import Callable
from functools import partial

import numpy as np

from bench.engines.metrics.contact_metric import ContactMetric, Pose
from bench.engines.metrics.measured_compliance import among_complying, compliance, complying, misaligned

# Relative gap between principal values of C up to which they count as one: what the moments' own size, some
# milliradians of rotation, may change C by, and a fifteenth of what Z-Y-X angles make of one degree of beta.
ALIKE = 1e-3


def misalignment(pose: Pose, of: Callable[[np.ndarray], float] = np.max) -> float:
    """Return the largest angle [rad] between e and C e over axes e that comply, or its mean; NaN: one is lost."""
    angles = misaligned(compliance(pose), complying(pose))
    return float(of(angles)) if len(angles) else np.nan


mean_misalignment = partial(misalignment, of=np.mean)


def least_yield(pose: Pose) -> float:
    """min |C m| / |m| [rad/(N m)] over the moments m in the span of the axes that comply: 0 means that one is lost."""
    yields = compliance(pose)[:, complying(pose)]
    return float(np.linalg.svd(yields, compute_uv=False)[-1]) if yields.size and np.isfinite(yields).all() else np.nan


def stiffness_asymmetry(pose: Pose) -> float:
    """|C - C^T| / |C + C^T|, Frobenius, among the axes that comply; NaN for less than two of them."""
    yields = among_complying(pose)
    if len(yields) < 2:
        return np.nan
    return float(np.linalg.norm(yields - yields.T) / np.linalg.norm(yields + yields.T))


def stiffness_axes(pose: Pose) -> float:
    """Return the largest angle [rad] of an axis that complies to the nearest principal axis (or plane) of (C + C^T)/2.

    An isotropic stiffness has every axis as a principal one, and the angle is 0. With Z-Y-X angles it is 45 degrees
    less half of |beta| from the first bit of beta on, however little the stiffness then differs from axis to axis.
    """
    yields = among_complying(pose)
    if len(yields) < 2 or not np.isfinite(yields).all():
        return np.nan
    values, axes = np.linalg.eigh(0.5 * (yields + yields.T))
    apart = np.flatnonzero(np.diff(values) > ALIKE * np.abs(values).max()) + 1
    shares = [np.linalg.norm(space, axis=1) for space in np.split(axes, apart, axis=1)]
    return float(np.arccos(np.clip(np.max(shares, axis=0), 0.0, 1.0)).max())


def stiffness_condition(pose: Pose) -> float:
    """Largest over smallest singular value of C among the axes that comply; NaN for less than two of them.

    The stiffness C^-1 has the same; with Z-Y-X angles it is (1 + |sin(beta)|)/(1 - |sin(beta)|).
    """
    yields = among_complying(pose)
    return float(np.linalg.cond(yields)) if len(yields) > 1 and np.isfinite(yields).all() else np.nan


METRICS = (
    ContactMetric("misalignment_rad", "rad", "largest angle between a moment and the rotation it causes", misalignment),
    ContactMetric(
        "mean_misalignment_rad", "rad", "mean angle between a moment and the rotation it causes", mean_misalignment
    ),
    ContactMetric("least_yield_rad_per_nm", "rad/(N m)", "least rotation per moment about complying axes", least_yield),
    ContactMetric(
        "stiffness_asymmetry", "1", "skew over symmetric part of the rotational stiffness", stiffness_asymmetry
    ),
    ContactMetric("stiffness_axes_rad", "rad", "largest angle of an axis asked for to a principal one", stiffness_axes),
    ContactMetric("stiffness_condition", "1", "condition number of the rotational stiffness", stiffness_condition),
)
