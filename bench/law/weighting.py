"""What counts as a large motion of the joints: one length, one gain, shared by the inverses that bound their answer.

A singular value of J mixes metres and radians, so a bound on it depends on the unit of length. LENGTH makes it a bound
on a pure number: J_W = W J has its translations divided by LENGTH. Rows of orientation count as they are, in radians
of the angular velocity or of the coordinates.
"""

from bench.law.linalg import factor, gram, gram_transposed, multiply_transposed, solve_factored
from bench.law.scalar import kernel

LENGTH = 0.5
"""[m]. About half the reach of the arms here (0.85 to 0.9 m): turning one joint by 1 rad moves the tool by this much at
half reach, and turns it by 1 rad."""

GREATEST_GAIN = 25.0
"""Every threshold of damping and truncation is derived from this, so that the inverses can be compared: each keeps
|x| <= GREATEST_GAIN |W a|, [rad/s^2] of joint acceleration for each unit of W a, a rad/s^2 or LENGTH/s^2.

The gain without a bound is 1 / sigma. Over poses drawn from the joints' whole ranges the median of the least sigma of
W J is 0.17 on the PUMA 560 and 0.13 on the UR5e: a bound of 25 is met at sigma = 0.04, in one pose of five or seven."""


def refuse_seven(why: str, rows: int, n: int) -> str:
    """Refuse seven rows on seven joints, whose rank is 6 everywhere, and say why that is too little."""
    if rows > 6 and n > 6:
        return (
            f"a {rows} x {n} Jacobian has rank 6, as a rigid body has six freedoms{why}; use damped-least-squares or "
            "truncated-svd"
        )
    return ""


@kernel
def weigh(J, a, J_W, a_W, rows, n):
    """J_W = W J and a_W = W a, W = diag(1/LENGTH, 1/LENGTH, 1/LENGTH, 1, ...)."""
    scale = 1.0 / LENGTH
    for i in range(3):
        a_W[i] = scale * a[i]
        for j in range(n):
            J_W[i, j] = scale * J[i, j]
    for i in range(3, rows):
        a_W[i] = a[i]
        for j in range(n):
            J_W[i, j] = J[i, j]


@kernel
def smaller_gram(J, S, rows, n):
    """S = J J^T or J^T J, whichever is smaller (lower half); returns its size. Both have the same singular values."""
    size = rows
    if rows > n:
        size = n
        gram_transposed(J, S, rows, n)
    else:
        gram(J, S, rows, n)
    return size


@kernel
def solve_gram(J, b, S, x, rows, n):
    """x = J^T S^-1 b if S is `smaller_gram`'s J J^T plus a multiple of I, or S^-1 J^T b if its J^T J plus it.

    The two are one answer (Golub & Van Loan 2013, 2.1.4). b and S are overwritten.
    """
    if rows > n:
        multiply_transposed(J, b, x, rows, n)
        factor(S, n)
        solve_factored(S, x, n)
    else:
        factor(S, rows)
        solve_factored(S, b, rows)
        multiply_transposed(J, b, x, rows, n)
