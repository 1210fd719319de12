"""Damped least squares that damps only near singularities (Chiaverini, Siciliano, Egeland 1994).

lambda^2 = (1 - sigma^2 / epsilon^2) lambda_max^2 where the least singular value sigma of W J is below epsilon, else 0.

Unless it is surely above epsilon, sigma is estimated afresh in each tick, from S = J_W J_W^T (or J_W^T J_W, if smaller)
and A = S + lambda_max^2 I. A step y := A^-1 y turns y towards the vector of sigma by (sigma^2 + lambda_max^2) /
(sigma_2^2 + lambda_max^2). The first y is LINPACK's, A^-1 of a vector of signs that makes it grow. The Rayleigh
quotient of the last one, (y . A y) / (y . y), is never below the least eigenvalue of A, so that sigma is never taken
for too small.

Limitations: as damped-least-squares does, but only within epsilon of a singularity; and where two singular values are
near epsilon the estimate may lie between them.
"""

from functools import partial

from bench.law import (
    GREATEST_GAIN,
    PUBLISHED,
    Inverse,
    copysign,
    exceeds,
    factor,
    kernel,
    refuse_seven,
    smaller_gram,
    solve_factored,
    solve_gram,
    solve_upper,
    weigh,
)

EPSILON = 1.0 / GREATEST_GAIN
"""Without damping the gain is 1 / sigma, which is GREATEST_GAIN here."""

MAX_DAMPING_SQUARED = 0.5 * EPSILON * EPSILON
"""lambda_max^2. With lambda^2 = (epsilon^2 - sigma^2) / 2 the gain is 2 sigma / (sigma^2 + epsilon^2): it falls all the
way from epsilon to 0, so that the bound holds; with less damping it would first rise."""

ITERATIONS = 3
"""Over 6000 random poses of the PUMA 560 and the UR5e, of those with sigma < epsilon: sigma^2 is too large by less than
0.001 epsilon^2 in 99 of 100, by 0.46 epsilon^2 in the worst one, where the gain is 29 instead of 25."""


@kernel
def least_eigenvalue(L, y, before, n):
    """Return an upper bound of the least eigenvalue of A = L L^T (as `factor` leaves it): y . A y / y . y.

    y and before are overwritten. The first y is A^-1 (+-1, ...), each sign taken so that L^-1 (+-1, ...) is the larger.
    """
    y[0] = L[0, 0]
    for i in range(1, n):
        total = L[i, 0] * y[0]
        for j in range(1, i):
            total = total + L[i, j] * y[j]
        y[i] = (-total - copysign(1.0, total)) * L[i, i]
    solve_upper(L, y, n)
    for _ in range(ITERATIONS):
        for i in range(n):
            before[i] = y[i]
        solve_factored(L, y, n)
    along = before[0] * y[0]
    square = y[0] * y[0]
    for i in range(1, n):
        along = along + before[i] * y[i]
        square = square + y[i] * y[i]
    return along / square


@kernel
def resolve(J, a, D, x, rows, n, scratch):
    """x = J_W^T (J_W J_W^T + lambda^2 I)^-1 W a, lambda by the estimate of sigma; by Cholesky's factors."""
    J_W, a_W, S, A = scratch.B, scratch.s, scratch.A, scratch.V
    weigh(J, a, J_W, a_W, rows, n)
    size = smaller_gram(J_W, S, rows, n)
    if not exceeds(S, EPSILON * EPSILON, A, size):
        damp(S, A, scratch.t, x, size)
    solve_gram(J_W, a_W, S, x, rows, n)


@kernel
def damp(S, A, y, before, n):
    """S := S + lambda^2 I, lambda by the estimate of sigma; A, y and before are overwritten."""
    for i in range(n):
        for j in range(i):
            A[i, j] = S[i, j]
        A[i, i] = S[i, i] + MAX_DAMPING_SQUARED
    factor(A, n)
    short = EPSILON * EPSILON + MAX_DAMPING_SQUARED - least_eigenvalue(A, y, before, n)
    if short > 0.0:
        damping = MAX_DAMPING_SQUARED / (EPSILON * EPSILON) * short
        for i in range(n):
            S[i, i] += damping


INVERSE = Inverse(
    name="damped-least-squares-variable",
    title="Damped least squares, variable",
    source=(
        "Chiaverini, Siciliano, Egeland 1994; the estimate of sigma and both limits are "
        "ours; also Nakamura & Hanafusa 1986"
    ),
    attribution=PUBLISHED,
    formula=r"\lambda^2 = \lambda_{\max}^2 \max\bigl(0,\; 1 - \sigma_{\min}^2 / \epsilon^2\bigr)",
    resolve=resolve,
    refuses=partial(refuse_seven, ": its least singular value is 0 at every pose and says nothing"),
)
