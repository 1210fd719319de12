"""Cholesky's factors of a symmetric positive definite matrix, S = L L^T, in place; the lower half is all that is read.

The diagonal holds 1 / L_ii: n divisions in all, here and in every solution.

Limitations: NaN if a pivot is negative, which S of a condition number above 1 / EPS may come to by rounding; 1/0 if it
is 0.
"""

from bench.law.scalar import kernel, sqrt

MARGIN = 2.0**-16
"""Least eigenvalue over the sum of all that counts as surely positive: what is solved by S has a condition number below
65536 then, and loses five of sixteen digits at most. The arms' own J J^T have sums up to 25: 4e-4 of it."""


@kernel
def factor(S, n):
    """S := L below the diagonal and 1 / L_ii on it, S = L L^T; (1/3) n^3 flops to leading order."""
    for j in range(n):
        pivot = S[j, j]
        for k in range(j):
            pivot = pivot - S[j, k] * S[j, k]
        inverse = 1.0 / sqrt(pivot)
        S[j, j] = inverse
        for i in range(j + 1, n):
            total = S[i, j]
            for k in range(j):
                total = total - S[i, k] * S[j, k]
            S[i, j] = total * inverse


@kernel
def exceeds(S, least, L, n):
    """Whether all eigenvalues of S are above `least`, and above MARGIN of their sum; S is left as it is.

    Where S - (least + MARGIN tr S) I has a factor, L, they are. Rounding of S = J J^T and of L (Higham 2002, 10.3), and
    of singular values that are computed otherwise, stays below 1024 EPS tr S, so that none of them is ever below.
    """
    total = S[0, 0]
    for i in range(1, n):
        total = total + S[i, i]
    shift = least + MARGIN * total
    for i in range(n):
        for j in range(i):
            L[i, j] = S[i, j]
        L[i, i] = S[i, i] - shift
    factor(L, n)
    return L[n - 1, n - 1] > 0.0


@kernel
def solve_lower(L, b, n):
    """b := L^-1 b, L as `factor` leaves it."""
    for i in range(n):
        total = b[i]
        for j in range(i):
            total = total - L[i, j] * b[j]
        b[i] = total * L[i, i]


@kernel
def solve_upper(L, b, n):
    """b := L^-T b, L as `factor` leaves it."""
    for down in range(n):
        i = n - 1 - down
        total = b[i]
        for j in range(i + 1, n):
            total = total - L[j, i] * b[j]
        b[i] = total * L[i, i]


@kernel
def solve_factored(L, b, n):
    """b := S^-1 b, S = L L^T as `factor` left it; 2 n^2 flops."""
    solve_lower(L, b, n)
    solve_upper(L, b, n)
