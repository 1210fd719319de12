"""Convert between matrices, quaternions (wxyz), rotation vectors and Euler angles, row by row."""

import functools

import numpy as np


def matrices(q: np.ndarray) -> np.ndarray:
    """Return R (n x 3 x 3) of unit quaternions (n x 4)."""
    w, x, y, z = q.T
    rows = (
        (w * w + x * x - y * y - z * z, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)),
        (2.0 * (x * y + w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z - w * x)),
        (2.0 * (x * z - w * y), 2.0 * (y * z + w * x), w * w - x * x - y * y + z * z),
    )
    return np.moveaxis(np.array(rows), 2, 0)


def product(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Return the Hamilton products p q (n x 4): first q, then p."""
    w, v, u, r = p[:, :1], p[:, 1:], q[:, :1], q[:, 1:]
    return np.hstack((w * u - (v * r).sum(axis=1, keepdims=True), w * r + u * v + np.cross(v, r)))


def axis_of(X: np.ndarray) -> np.ndarray:
    """Return 2 sin(theta) k of rotations X (n x 3 x 3)."""
    return np.stack((X[:, 2, 1] - X[:, 1, 2], X[:, 0, 2] - X[:, 2, 0], X[:, 1, 0] - X[:, 0, 1]), axis=1)


def rotated(X: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Return X v (n x 3)."""
    return np.einsum("nij,nj->ni", X, v)


def exp(v: np.ndarray) -> np.ndarray:
    """Return rotations (n x 3 x 3) of rotation vectors (n x 3) [rad]."""
    half = np.linalg.norm(v, axis=1, keepdims=True) / 2.0
    return matrices(np.hstack((np.cos(half), np.sinc(half / np.pi) / 2.0 * v)))


def log(R: np.ndarray) -> np.ndarray:
    """Return rotation vectors (n x 3) [rad] of rotations: 4 q q^T is linear in R, and its largest row is 4 q_i q."""
    trace, Q = np.einsum("nii->n", R), np.empty((len(R), 4, 4))
    Q[:, 0, 0] = 1.0 + trace
    Q[:, 0, 1:] = Q[:, 1:, 0] = axis_of(R)
    Q[:, 1:, 1:] = R + R.swapaxes(1, 2) + (1.0 - trace)[:, None, None] * np.eye(3)
    q = Q[np.arange(len(R)), np.einsum("nii->ni", Q).argmax(axis=1)]
    q = q * np.where(q[:, :1] < 0.0, -1.0, 1.0)
    size = np.linalg.norm(q[:, 1:], axis=1)
    return q[:, 1:] * (2.0 * np.arctan2(size, q[:, 0]) / np.maximum(size, 1e-300))[:, None]


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
