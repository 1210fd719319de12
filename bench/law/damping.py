"""Damping design for a given stiffness matrix: an impedance that leaves the hand its own inertia."""

from collections.abc import Callable
from typing import NamedTuple


class Damping(NamedTuple):
    """design(K, Lambda, zeta, D, scratch): writes the damping D (6 x 6) [N s/m, N m s/rad], base frame.

    K: six stiffnesses [N/m, N m/rad]; Lambda: the hand's inertia at the pose, 6 x 6, both halves; zeta: the ratio that
    is asked for. Neither K nor Lambda is changed. formula: of D, in TeX.
    """

    name: str
    title: str
    source: str
    formula: str
    design: Callable
