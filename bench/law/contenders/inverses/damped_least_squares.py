"""Damped least squares: the x that makes |W (J x - a)|^2 + lambda^2 |x|^2 least.

Along a singular vector of W J with the value sigma the answer is sigma / (sigma^2 + lambda^2) of the command, at most
1 / (2 lambda); the rest of the command, lambda^2 / (sigma^2 + lambda^2) of it, is lost. With lambda = 0.02 that is 1 %
at sigma = 0.2, half at sigma = lambda, and never nothing.

Limitations: only where J itself is not finite; everywhere it gives less than was commanded.
"""

from bench.law import GREATEST_GAIN, PUBLISHED, Inverse, kernel, smaller_gram, solve_gram, weigh

DAMPING = 0.5 / GREATEST_GAIN
"""lambda: sigma / (sigma^2 + lambda^2) is largest at sigma = lambda, where it is 1 / (2 lambda) = GREATEST_GAIN."""


@kernel
def resolve(J, a, D, x, rows, n, scratch):
    """x = J_W^T (J_W J_W^T + lambda^2 I)^-1 W a, J_W = W J; by Cholesky's factors."""
    J_W, a_W, S = scratch.B, scratch.s, scratch.A
    weigh(J, a, J_W, a_W, rows, n)
    size = smaller_gram(J_W, S, rows, n)
    for i in range(size):
        S[i, i] += DAMPING * DAMPING
    solve_gram(J_W, a_W, S, x, rows, n)


INVERSE = Inverse(
    name="damped-least-squares",
    title="Damped least squares",
    source=(
        "Nakamura & Hanafusa 1986; lambda = 0.02 and the unit of length are ours; also "
        "Wampler 1986"
    ),
    attribution=PUBLISHED,
    formula=r"\ddot q = J_W^\top (J_W J_W^\top + \lambda^2 I)^{-1}\, W a, \quad J_W = W J",
    resolve=resolve,
)
