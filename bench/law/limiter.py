"""Velocity limiters, applied before a velocity command is sent."""

from collections.abc import Callable
from typing import NamedTuple

GREATEST_RATE = 2.0
"""[rad/s]. What limiters let pass at most: robot arms turn their tools at 1 to 3 rad/s; half a turn takes 1.6 s."""


class Limiter(NamedTuple):
    """limit(omega, K) -> omega: what is passed on of a commanded angular velocity [rad/s, base frame].

    K: the law's gain [1/s], for what is said of the error. formula: in TeX.
    """

    name: str
    title: str
    source: str
    formula: str
    limit: Callable
