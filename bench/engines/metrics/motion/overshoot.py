"""Overshoot: the greatest angle to the goal after the settling band was first entered [rad]; 0 if it is never left.

About a fixed axis it is how far the body turns past the goal. Of the damped linear loop from rest (rotation-vector,
zeta = kv/(2 sqrt(kp)) < 1) it is exp(-pi zeta/sqrt(1 - zeta^2)) times the start angle, wherever that is more than the
band. Limitations: a body that passes the goal at more than the band's distance has not entered it yet; an episode in
which the band is never entered has the overshoot 0, too.
"""

import math

from bench.engines.metrics.metric import Metric
from bench.law import kernel


@kernel
def largest_haversine(value, sample):
    """Largest haversine since the band was first entered."""
    return max(value, sample.haversine) if sample.entered else value


def angle_outside(value, ending):
    """Return the angle, if it lies outside the band; else 0."""
    angle = 2.0 * math.asin(min(1.0, math.sqrt(value)))
    return angle if angle > ending.band else 0.0


METRIC = Metric(
    "overshoot_rad", "rad", "largest angle after the band was first entered", 0.0, largest_haversine, angle_outside
)
