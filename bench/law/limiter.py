"""What stands between a velocity law and the robot that is told velocities."""

from collections.abc import Callable
from typing import NamedTuple


class Limiter(NamedTuple):
    """limit(omega, K) -> omega: what is passed on of a commanded angular velocity [rad/s, base frame].

    K: the law's gain [1/s], for what is said of the error. formula: in TeX.
    """

    name: str
    title: str
    source: str
    formula: str
    limit: Callable
