"""Calling an inverse on Jacobians of every kind: what its contract and its own tests share."""

import functools

import numpy as np

from bench.law.weighting import LENGTH
from support.bits import EPS
from support.buffers import as_floats, buffer, matrices, poses, scratch, symmetric

SHAPES = [(6, 6), (6, 7), (7, 6), (7, 7)]
A = np.array([1.0, -2.0, 0.5, 0.3, 1.5, -0.7, 0.2])
# Cholesky's factors of J J^T or J D^-1 J^T: 4 n (3 n + 1) EPS each (Higham 2002, theorem 10.4) of two of them.
FACTORED = 8 * 7 * 22 * EPS


def accepted(inverse):
    return [shape for shape in SHAPES if not inverse.refuses(*shape)]


@functools.cache
def inertia(n):
    return symmetric(n)["random-5"]


def resolved(inverse, J, a, D, dtype=float, resolve=None):
    """x, and what is left of J, a and D."""
    rows, n = J.shape
    given = [buffer(part, dtype) for part in (J, a, D)]
    x = buffer(np.full(n, np.nan), dtype)
    with np.errstate(all="ignore"):
        (resolve or inverse.resolve)(*given, x, rows, n, scratch(dtype))
    return as_floats(x)[:n], [as_floats(part) for part in given]


@functools.cache
def well_conditioned(rows, n):
    """Jacobians of a random arm's poses; of seven rows with the linear map of omega to a quaternion's rates."""
    found = []
    for arm, _ in poses(n, 40):
        J = arm.jacobian
        if rows > 6:
            Xi = 0.5 * np.array([[-0.1, -0.5, -0.7], [0.5, 0.7, 0.1], [-0.7, 0.5, -0.1], [-0.1, -0.1, 0.5]])
            q, _ = np.linalg.qr(Xi)
            J = np.vstack([J[:3], 0.5 * q @ J[3:]])
        weighed = J / np.where(np.arange(rows) < 3, LENGTH, 1.0)[:, None]
        if np.linalg.svd(weighed, compute_uv=False)[5] > 0.1:  # above all thresholds of damping and truncation
            found.append(J)
    return found


@functools.cache
def anything(rows, n):
    return matrices(rows, n) | {f"pose-{i}": J for i, J in enumerate(well_conditioned(rows, n))}
