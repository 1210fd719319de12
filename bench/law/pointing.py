"""A law of reduced attitude: it points an axis of the body, a in S^2, and leaves the turn about it as it is."""

from collections.abc import Callable
from typing import NamedTuple


class Pointing(NamedTuple):
    """u = law(a, omega, a_d, gains): commanded angular acceleration in the base frame [rad/s^2].

    a, a_d: unit vectors, where the axis points and where it shall, base frame. It is judged by the angle between them,
    which two of three degrees of freedom decide, and takes no part where whole orientations are judged.

    spring(theta): f in theta'' = -Kp f(theta) - Kv theta' of a body at rest at first.
    keeps_spin: whether a . omega, the rate about the axis, stays as it is; else it is damped.
    property: what is proved of it.
    """

    name: str
    title: str
    source: str
    formula: str
    law: Callable
    spring: Callable
    keeps_spin: bool
    property: str
