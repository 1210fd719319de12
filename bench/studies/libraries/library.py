"""What is asked of a library: functions that its users take for the error between two orientations.

Every function is asked for the turn T that leads from R = I to R_d = T, so that R_d R^T, R^T R_d and R_d are one and
the same, exactly, and the base and the body frame agree on its axis.
"""

from collections.abc import Callable
from typing import NamedTuple

MATRIX, QUATERNION = "matrix", "quaternion"


class Function(NamedTuple):
    """One function of a library.

    call(turn) -> three numbers: of a 3 x 3 array if it takes a matrix, else of a unit quaternion (w, x, y, z). Scaled
    so that near the identity they are theta k; angles stand as those about x, y and z.
    form: what the three numbers are, a word of `forms.FORMS`.
    """

    name: str
    takes: str
    call: Callable
    form: str = "rotation-vector"


class Library(NamedTuple):
    """A library by the name that its package is installed under, and what is asked of it."""

    name: str
    package: str
    functions: tuple[Function, ...]
