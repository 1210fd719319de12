"""The least time in which a bounded command turns a body that rests to a goal that rests, whatever the law.

With |u| <= a the speed at time t is a t at most, and a (T - t) at most where the body is to rest at T: an angle theta
takes T = 2 sqrt(theta/a), the command full one way and then the other. A body that need only stay in a band of half
width b arrives with the speed 2 sqrt(a b) at the near edge, and stops at the far one:

    T = 2 sqrt((theta + b)/a) - 2 sqrt(b/a)

Limitations: from rest only; the far edge of the band is as a wall is, the body is not asked to rest at the goal.
"""

import math

from bench.base.bisection import bisect
from tasks.rules import RULES

HALVINGS = 50


def least_time(angle: float, acceleration: float, tolerance: float = RULES.tolerance) -> float:
    """Return the least time [s] to an angle's band; acceleration [rad/s^2] is the greatest about any axis."""
    band = tolerance * angle
    return 2.0 * (math.sqrt((angle + band) / acceleration) - math.sqrt(band / acceleration))


def angle_of_share(share: float) -> float:
    """Return the angle [rad] that this share of uniform orientations does not exceed: (angle - sin angle)/pi."""
    return bisect(lambda angle: angle - math.sin(angle) < share * math.pi, 0.0, math.pi, HALVINGS)[1]
