"""Gauss elimination with partial pivoting, in place.

Magnitudes are compared by copysign(x, 1.0), which is exact for every number; squares would be zero below 1e-162, and
a matrix of such numbers would be called singular that is not.

Fails: an exactly singular matrix gives a pivot of 0, and 0/0 or 1/0 from there on.
"""

from bench.scalar import copysign, kernel


@kernel
def raise_pivot(A, k, n):
    """Swap the row from k on that is largest in column k into row k; returns the row it came from."""
    largest, row = copysign(A[k, k], 1.0), k
    for i in range(k + 1, n):
        size = copysign(A[i, k], 1.0)
        if size > largest:
            largest, row = size, i
    if row > k:
        for j in range(k, n):
            A[k, j], A[row, j] = A[row, j], A[k, j]
    return row


@kernel
def solve(A, b, n):
    """b := A^-1 b; A (n x n) is overwritten.

    (2/3) n^3 flops to leading order. The answer is that of a matrix within 1.5 n^3 growth EPS |A| of A, the growth of
    the pivots at most 2^(n-1) and in practice near 1 (Wilkinson; Higham 2002, theorem 9.5).
    """
    for k in range(n):
        row = raise_pivot(A, k, n)
        if row > k:
            b[k], b[row] = b[row], b[k]
        for i in range(k + 1, n):
            share = A[i, k] / A[k, k]
            for j in range(k + 1, n):
                A[i, j] -= share * A[k, j]
            b[i] -= share * b[k]
    for down in range(n):
        i = n - 1 - down
        total = b[i]
        for j in range(i + 1, n):
            total = total - A[i, j] * b[j]
        b[i] = total / A[i, i]


@kernel
def determinant(A, n):
    """det A; A (n x n) is overwritten. Zero at once where a column has no pivot."""
    product = A[0, 0]
    for k in range(n):
        row = raise_pivot(A, k, n)
        pivot = A[k, k]
        if k > 0:
            product = product * pivot
        else:
            product = pivot
        if row > k:
            product = -product
        if pivot <= 0.0 and pivot >= 0.0:
            break
        for i in range(k + 1, n):
            share = A[i, k] / pivot
            for j in range(k + 1, n):
                A[i, j] -= share * A[k, j]
    return product
