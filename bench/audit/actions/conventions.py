"""Name what an action can mean: a representation (numbers to a rotation A) and a relation from pose R to the next R'.

Capital Euler letters are intrinsic, A = R_1 R_2 R_3; small ones extrinsic, A = R_3 R_2 R_1.
"""

import functools
import itertools
from collections.abc import Callable

import numpy as np

from bench.audit.rotations import exp, from_euler, log, matrices, to_euler

RELATIONS = {"base": "R' = A R", "body": "R' = R A", "absolute": "R' = A", "difference": "c(R') = c(R) + a"}
"""Formulas; c are the coordinates of the representation."""


def unit(v: np.ndarray) -> np.ndarray:
    """Return vectors (n x m) of length 1."""
    return v / np.maximum(np.linalg.norm(v, axis=1, keepdims=True), 1e-300)


def from_columns(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return rotations whose first column is along a (n x 3), and whose second is along b after Gram and Schmidt."""
    x = unit(a)
    y = unit(b - (x * b).sum(axis=1, keepdims=True) * x)
    return np.stack((x, y, np.cross(x, y)), axis=2)


ORDERS = ["".join(one) for one in itertools.product("xyz", repeat=3) if one[0] != one[1] != one[2]]
ORDERS += [order.upper() for order in ORDERS]
REPRESENTATIONS: dict[int, dict[str, Callable]] = {
    3: {"rotation-vector": exp, **{f"euler-{one}": functools.partial(from_euler, one) for one in ORDERS}},
    4: {
        "quaternion-wxyz": lambda a: matrices(unit(a)),
        "quaternion-xyzw": lambda a: matrices(unit(a[:, [3, 0, 1, 2]])),
    },
    6: {
        "6d-rows": lambda a: from_columns(a[:, :3], a[:, 3:]).swapaxes(1, 2),
        "6d-columns": lambda a: from_columns(a[:, :3], a[:, 3:]),
        "6d-interleaved": lambda a: from_columns(a[:, ::2], a[:, 1::2]),
    },
    9: {
        "matrix-rows": lambda a: from_columns(a[:, ::3], a[:, 1::3]),
        "matrix-columns": lambda a: from_columns(a[:, :3], a[:, 3:6]),
    },
}
"""Decoders by the count of numbers; 6d-interleaved is R[:, :2] flattened."""
COORDINATES: dict[str, Callable] = {"rotation-vector": log}
COORDINATES |= {f"euler-{one}": functools.partial(to_euler, one) for one in ORDERS if len({*one}) == 3}
"""Coordinates whose differences are taken for actions."""
