"""Name what an action can mean: a representation (numbers to a rotation A) and a relation from pose R to the next R'.

Capital Euler letters are intrinsic, A = R_1 R_2 R_3; small ones extrinsic, A = R_3 R_2 R_1.
"""

import functools
import itertools
from collections.abc import Callable

import numpy as np

from bench.audit.pairs import matrices

RELATIONS = {"base": "R' = A R", "body": "R' = R A", "absolute": "R' = A", "difference": "c(R') = c(R) + a"}
"""Formulas; c are the coordinates of the representation."""


def exp(v: np.ndarray) -> np.ndarray:
    """Return rotations (n x 3 x 3) of rotation vectors (n x 3) [rad]."""
    half = np.linalg.norm(v, axis=1, keepdims=True) / 2.0
    return matrices(np.hstack((np.cos(half), np.sinc(half / np.pi) / 2.0 * v)))


def log(R: np.ndarray) -> np.ndarray:
    """Return rotation vectors (n x 3) [rad] of rotations: 4 q q^T is linear in R, and its largest row is 4 q_i q."""
    trace, Q = np.einsum("nii->n", R), np.empty((len(R), 4, 4))
    Q[:, 0, 0] = 1.0 + trace
    Q[:, 0, 1:] = Q[:, 1:, 0] = np.stack([R[:, 2, 1] - R[:, 1, 2], R[:, 0, 2] - R[:, 2, 0], R[:, 1, 0] - R[:, 0, 1]], 1)
    Q[:, 1:, 1:] = R + R.swapaxes(1, 2) + (1.0 - trace)[:, None, None] * np.eye(3)
    q = Q[np.arange(len(R)), np.einsum("nii->ni", Q).argmax(axis=1)]
    q = q * np.where(q[:, :1] < 0.0, -1.0, 1.0)
    size = np.linalg.norm(q[:, 1:], axis=1)
    return q[:, 1:] * (2.0 * np.arctan2(size, q[:, 0]) / np.maximum(size, 1e-300))[:, None]


def unit(v: np.ndarray) -> np.ndarray:
    """Return vectors (n x m) of length 1."""
    return v / np.maximum(np.linalg.norm(v, axis=1, keepdims=True), 1e-300)


def from_euler(order: str, angles: np.ndarray) -> np.ndarray:
    """Return rotations of angles (n x 3) [rad] about the axes of the order, as "XYZ" or "xyz"."""
    turns = [exp(angles[:, [n]] * np.eye(3)["xyz".index(axis)]) for n, axis in enumerate(order.lower())]
    return functools.reduce(np.matmul, turns if order.isupper() else turns[::-1])


def to_euler(order: str, R: np.ndarray) -> np.ndarray:
    """Return the angles (n x 3) [rad] of an order of three different axes; R = R_i R_j R_k has sin(b) at (i, k)."""
    i, j, k = ("xyz".index(axis) for axis in (order.lower() if order.isupper() else order[::-1]))
    sign = 1.0 if (j - i) % 3 == 1 else -1.0
    first, third = np.arctan2(-sign * R[:, j, k], R[:, k, k]), np.arctan2(-sign * R[:, i, j], R[:, i, i])
    found = np.stack((first, np.arcsin(np.clip(sign * R[:, i, k], -1.0, 1.0)), third), axis=1)
    return found if order.isupper() else found[:, ::-1]


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
