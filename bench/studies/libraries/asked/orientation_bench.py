"""Ours: the laws on R of this benchmark at rest, with kp = 1 and so the error itself."""

import numpy as np

from bench.law.contender import AT_REST, Gains, Goal
from bench.law.contenders.registry import find_contender
from bench.law.so3 import IDENTITY, Rotation
from bench.studies.libraries.library import MATRIX, Function, Library

GAINS = Gains(kp=1.0, kv=0.0)


def law(word, form) -> Function:
    """The law by its name."""
    one = find_contender(word)

    def error(R) -> np.ndarray:
        u = one.law(IDENTITY, AT_REST, Goal(Rotation(*map(tuple, R.T))), GAINS)
        return np.array(u)

    return Function(word, MATRIX, error, form)


LIBRARY = Library(
    "orientation-bench",
    "orientation-bench",
    (
        law("rotation-vector", "rotation-vector"),
        law("square-root", "sine-of-half"),
        law("quaternion-shortest", "sine-of-half"),
        law("mrp", "mrp"),
        law("rotation-matrix", "sine"),
    ),
)
