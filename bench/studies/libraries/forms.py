"""What three numbers can say of a turn by theta about k, each theta k near the identity.

The rotation vector is the error itself. The others are errors of their own right, and laws have been built on each;
only `sin(theta) k` is nought at half turns, and only Euler angles have poles. A function is first judged by its own
form, so that what it means is told apart from what it gets wrong.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np


class Form(NamedTuple):
    """A form by its closed form: size(theta), along k; or for angles, matrix(e), the turn that they stand for."""

    title: str
    size: Callable | None = None
    matrix: Callable | None = None


def _about(i: int, angle: float) -> np.ndarray:
    """The turn by an angle about base axis i."""
    c, s = math.cos(angle), math.sin(angle)
    R = np.eye(3)
    j, k = (i + 1) % 3, (i + 2) % 3
    R[j, j], R[j, k], R[k, j], R[k, k] = c, -s, s, c
    return R


def _z_y_x(e) -> np.ndarray:
    """R_z(e_z) R_y(e_y) R_x(e_x) (Murphy 1988, 2.4)."""
    return _about(2, e[2]) @ _about(1, e[1]) @ _about(0, e[0])


FORMS = {
    "rotation-vector": Form("θ", size=lambda theta: theta),
    "sine-of-half": Form("2 sin(θ/2)", size=lambda theta: 2.0 * math.sin(theta / 2.0)),
    "sine": Form("sin θ", size=math.sin),
    "mrp": Form("4 tan(θ/4)", size=lambda theta: 4.0 * math.tan(theta / 4.0)),
    "z-y-x": Form("Z-Y-X angles", matrix=_z_y_x),
}
