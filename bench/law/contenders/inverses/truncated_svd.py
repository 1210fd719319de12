"""The pseudo-inverse without small singular values: x = sum of (u_i . W a) / sigma_i v_i over sigma_i > TOLERANCE.

From W J with its rows turned until they are orthogonal (linalg/rotations.py): each is sigma_i v_i^T, and W a turned
with them is u_i . W a. Where all sigma_i are surely above TOLERANCE nothing is left out, and the normal equations give
the same answer in a fifth of the time.

Limitations: the answer jumps where a singular value crosses the tolerance, and what was commanded along the
directions left out is not done at all.
"""

from bench.law import (
    GREATEST_GAIN,
    PUBLISHED,
    Inverse,
    dot_rows,
    exceeds,
    kernel,
    multiply_transposed,
    orthogonalize,
    smaller_gram,
    solve_gram,
    weigh,
)

TOLERANCE = 1.0 / GREATEST_GAIN
"""The gain along v_i is 1 / sigma_i, so that what is left keeps to GREATEST_GAIN."""


@kernel
def resolve(J, a, D, x, rows, n, scratch):
    """x = (W J)^+ W a if no singular value is near TOLERANCE or below, else by the sum over those above it."""
    J_W, a_W, S = scratch.B, scratch.s, scratch.A
    weigh(J, a, J_W, a_W, rows, n)
    is_full = False
    if rows < 7 or n < 7:  # seven rows on seven joints have rank 6 at every pose
        is_full = exceeds(S, TOLERANCE * TOLERANCE, scratch.V, smaller_gram(J_W, S, rows, n))
    if is_full:
        solve_gram(J_W, a_W, S, x, rows, n)
    else:
        solve_truncated(J_W, a_W, x, rows, n)


@kernel
def solve_truncated(J_W, a_W, x, rows, n):
    """x = sum over sigma_i > TOLERANCE of (u_i . W a) / sigma_i^2 times row i of U^T W J; J_W and a_W change."""
    orthogonalize(J_W, a_W, rows, n)
    for i in range(rows):
        square = dot_rows(J_W, i, J_W, i, n)
        if square > TOLERANCE * TOLERANCE:
            a_W[i] = a_W[i] / square
        else:
            a_W[i] = 0.0
    multiply_transposed(J_W, a_W, x, rows, n)


INVERSE = Inverse(
    name="truncated-svd",
    title="Truncated SVD",
    source=(
        "Golub & Kahan 1965; the tolerance 0.04 and the unit of length are ours; also "
        "Hestenes 1958"
    ),
    attribution=PUBLISHED,
    formula=r"\ddot q = \sum_{\sigma_i > \epsilon} \frac{u_i \cdot W a}{\sigma_i}\, v_i, \quad W J = U \Sigma V^\top",
    resolve=resolve,
)
