"""The judge's linear algebra, by MuJoCo's Cholesky factors: the same bits whichever BLAS numpy came with.

Start sets are found by searches. With numpy's solve, lstsq and svd, which round and choose signs as the kernel of the
machine does, they would be other ones on another processor.
Squaring A costs half of the digits. `least_norm` gets them back by iterative refinement; the others serve Newton's
method, whose steps may be inexact by eps cond(A)^2 without moving what it converges to.

Limitations: None where A A^T is singular to rounding, cond(A) about 1e8 and more.
"""

from __future__ import annotations

import mujoco
import numpy as np

# Pivot of a Cholesky factor below which a matrix is singular: 1e-16 of the squared elements of order 1, and some.
PIVOT = 1e-15
# Each gains the digits that the first solution has.
REFINEMENTS = 2
# Each step of inverse iteration shrinks the other singular vectors by (sigma/sigma_5)^2: near a singularity one or two
# do; far from any, where this vector is a first guess alone, so many leave it right to a per cent or so.
INVERSE_ITERATIONS = 300
# Enough for a tenth between the two largest singular values; any mixture of two that are nearer serves as well.
POWER_ITERATIONS = 100
WEIGHT = 0.7


def least_norm(A: np.ndarray, b: np.ndarray) -> np.ndarray | None:
    """Return A^T (A A^T)^-1 b, the shortest x with A x = b; A is m x n, m <= n. None if rows are dependent."""
    gram = _gram(A)
    if mujoco.mju_cholFactor(gram, PIVOT) < len(A):
        return None
    x = transposed_product(A, _solved(gram, b))
    for _ in range(REFINEMENTS):
        x += transposed_product(A, _solved(gram, b - product(A, x)))
    return x


def damped(A: np.ndarray, b: np.ndarray, lambda_: float) -> np.ndarray:
    """Return (A^T A + lambda I)^-1 A^T b, for lambda > 0."""
    gram = _gram(A.T)
    gram.flat[:: len(gram) + 1] += lambda_
    mujoco.mju_cholFactor(gram, PIVOT)
    return _solved(gram, transposed_product(A, b))


def of_lost_rank(A: np.ndarray, u: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return A^+ b where A has lost one rank, u being the unit vector with A^T u = 0, and b . u = 0.

    A A^T + u u^T is regular, and on all that A reaches it is A A^T.
    """
    gram = _gram(A) + np.multiply.outer(u, u)
    mujoco.mju_cholFactor(gram, PIVOT)
    return transposed_product(A, _solved(gram, b))


def smallest(A: np.ndarray) -> tuple[float, np.ndarray]:
    """(sigma, u): smallest singular value of A, m x n with m <= n, and its left singular vector, `signed`.

    Inverse iteration on A A^T. Where the next singular value is some hundredths of |A|, sigma = |A^T u| is right to
    about 1e-14 |A|.
    """
    gram = _gram(A)
    mujoco.mju_cholFactor(gram, PIVOT)  # a smaller pivot becomes PIVOT: what that magnifies is the vector sought
    u = np.ones(len(A))
    for _ in range(INVERSE_ITERATIONS):
        u = unit(_solved(gram, u))
    return length(transposed_product(A, u)), signed(u)


def largest(A: np.ndarray) -> np.ndarray:
    """Return the right singular vector of the largest singular value of A, `signed`, by power iteration on A^T A."""
    gram = _gram(A.T)
    v = gram[gram.diagonal().argmax()]
    for _ in range(POWER_ITERATIONS):
        v = unit(product(gram, v))
    return signed(v)


def length(v: np.ndarray) -> float:
    """|v|."""
    return float(mujoco.mju_norm(np.ascontiguousarray(v)))


def unit(v: np.ndarray) -> np.ndarray:
    """v/|v|."""
    return v / length(v)


def signed(v: np.ndarray) -> np.ndarray:
    """v or -v: the one with v_1 + 0.7 v_2 + 0.49 v_3 + ... > 0, weights that no symmetry of an arm cancels."""
    return v if float(sum(x * WEIGHT**i for i, x in enumerate(v.tolist()))) > 0.0 else -v


def product(A: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Return A v."""
    result = np.empty(len(A))
    mujoco.mju_mulMatVec(result, np.ascontiguousarray(A), np.ascontiguousarray(v))
    return result


def transposed_product(A: np.ndarray, v: np.ndarray) -> np.ndarray:
    """A^T v."""
    result = np.empty(A.shape[1])
    mujoco.mju_mulMatTVec(result, np.ascontiguousarray(A), np.ascontiguousarray(v))
    return result


def _gram(A: np.ndarray) -> np.ndarray:
    """Return A A^T."""
    A, result = np.ascontiguousarray(A), np.empty((len(A), len(A)))
    mujoco.mju_mulMatMatT(result, A, A)
    return result


def _solved(factor: np.ndarray, b: np.ndarray) -> np.ndarray:
    x = np.empty(len(factor))
    mujoco.mju_cholSolve(x, factor, np.ascontiguousarray(b))
    return x
