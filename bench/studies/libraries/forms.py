"""What three numbers of a library can say of a turn: a form of the audit, or Z-Y-X angles."""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from bench.audit.forms import FORMS as SIZED


class Form(NamedTuple):
    """A form by its closed form: size(theta), along k; or for angles, matrix(e), the turn that they stand for.

    angles(length) -> the angles in [0, 2 pi) that an answer of this length stands for.
    """

    title: str
    size: Callable | None = None
    angles: Callable | None = None
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


ANGLES_OF = {
    "rotation-vector": lambda length: (length,),
    "sine-of-half": lambda length: (2.0 * math.asin(min(1.0, 0.5 * length)),),
    "sine": lambda length: (math.asin(min(1.0, length)), math.pi - math.asin(min(1.0, length))),
    "mrp": lambda length: (4.0 * math.atan(0.25 * length),),
}
FORMS = {name: Form(*SIZED[name], angles) for name, angles in ANGLES_OF.items()} | {
    "z-y-x": Form("Z-Y-X angles", matrix=_z_y_x)
}
