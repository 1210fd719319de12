"""Cholesky's factors of a symmetric positive definite matrix, S = L L^T, in place; the lower half is all that is read.

The diagonal holds 1 / L_ii: n divisions in all, here and in every solution.

Fails: NaN if a pivot is negative, which S of a condition number above 1 / EPS may come to by rounding; 1/0 if it is 0.
"""

from bench.law.scalar import kernel, sqrt


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
