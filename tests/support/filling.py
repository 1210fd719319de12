"""Calling Jacobians' kernels in every representation and inverses on Jacobians of every kind, for their contracts."""

import functools

import numpy as np

from bench.law.chain import twist
from bench.law.contenders.registry import contenders
from bench.law.weighting import LENGTH
from support.bits import EPS
from support.buffers import as_floats, buffer, matrices, of_numbers, poses, scratch, symmetric

EVERY = contenders("jacobians").values()
ON_OMEGA = [(one, None) for one in EVERY if one.takes == "angular-acceleration"]
ON_COORDINATES = [
    (one, coordinates)
    for one in EVERY
    if one.takes == "coordinates"
    for coordinates in contenders("representations").values()
    if coordinates.differentiate is not None or not one.needs_derivatives
]
PAIRS = ON_OMEGA + ON_COORDINATES
# What MuJoCo hands over and what is made of it: products of n rotations, then sums of a few products each.
ROUNDING = 200 * EPS
AWAY = 0.1
"""Margin from the singular set; what is divided by it errs by ROUNDING over its square at most."""


def named(pair):
    one, coordinates = pair
    return one.name if coordinates is None else f"{one.name}-{coordinates.name}"


def rows_of(coordinates):
    return 3 + (3 if coordinates is None else len(coordinates.symbols))


def filled(pair, chain, dtype=float, fill=None):
    """J as the kernel leaves its buffer, NaN where it was not written."""
    one, coordinates = pair
    J = buffer(np.zeros((0, 0)), dtype)
    kernel = fill or one.kernels_in(coordinates)[0]
    chain = of_numbers(chain, dtype)
    with np.errstate(all="ignore"):
        kernel(J, chain, *(() if coordinates is None else (coordinates.chart(chain.R),)))
    return as_floats(J)


def converted(pair, chain, given, dtype=float, convert=None):
    """The six numbers expressed, or as `bias` of the drift."""
    one, coordinates = pair
    kernel = convert or one.kernels_in(coordinates)[1]
    chain, given = of_numbers(chain, dtype), of_numbers(given, dtype)
    with np.errstate(all="ignore"):
        if coordinates is None:
            return as_floats(np.array(kernel(chain, given), dtype=object))
        at, (_, omega) = coordinates.chart(chain.R), twist(chain)
        answer = kernel(chain, at, coordinates.rates(at, omega), omega, given)
        return as_floats(np.array(answer, dtype=object))


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
