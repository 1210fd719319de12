"""Operational-space torques from the eigenvalues of Lambda^-1 = J D^-1 J^T, for inverses that change the small ones.

With D = L L^T the singular values of Y^T = J L^-T are the roots sigma of these eigenvalues. The torque of Khatib,
tau = J^T Lambda a, is L Y^T+ a: the sum of (u_i . a) / sigma_i^2 times L sigma_i v_i. An inverse puts another factor in
the place of 1 / sigma_i^2. Eigenvalues mix metres and radians, as in the libraries whose rules these are.
"""

from bench.law.linalg import dot_rows, factor, multiply, multiply_transposed, orthogonalize, solve_lower, solve_upper
from bench.law.scalar import kernel


@kernel
def whiten(J, D, rows, n, scratch):
    """Write L and Y^T = J L^-T into scratch B and V; t is overwritten."""
    L, Y_transposed, column = scratch.B, scratch.V, scratch.t
    for i in range(n):
        for j in range(i + 1):
            L[i, j] = D[i, j]
    factor(L, n)
    for i in range(rows):
        for j in range(n):
            column[j] = J[i, j]
        solve_lower(L, column, n)
        for j in range(n):
            Y_transposed[i, j] = column[j]


@kernel
def decompose(J, a, D, rows, n, scratch):
    """Write L, the rows sigma_i v_i^T and the numbers u_i . a into scratch B, V and s."""
    whiten(J, D, rows, n, scratch)
    for i in range(rows):
        scratch.s[i] = a[i]
    orthogonalize(scratch.V, scratch.s, rows, n)


@kernel
def eigenvalue(i, n, scratch):
    """Return sigma_i^2, an eigenvalue of J D^-1 J^T."""
    return dot_rows(scratch.V, i, scratch.V, i, n)


@kernel
def greatest_eigenvalue(rows, n, scratch):
    """Return the greatest sigma_i^2."""
    greatest = eigenvalue(0, n, scratch)
    for i in range(1, rows):
        greatest = max(greatest, eigenvalue(i, n, scratch))
    return greatest


@kernel
def compose(D, x, rows, n, scratch):
    """x = D L^-T (sum of s_i times row i), which is L times the sum: the torques."""
    column = scratch.t
    multiply_transposed(scratch.V, scratch.s, column, rows, n)
    solve_upper(scratch.B, column, n)
    multiply(D, column, x, n, n)
