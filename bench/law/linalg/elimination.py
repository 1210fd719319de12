"""Gauss elimination with partial pivoting, in place.

Magnitudes are compared by copysign(x, 1.0), which is exact for every number; squares would be zero below 1e-162, and
a matrix of such numbers would be called singular that is not.

Limitations: an exactly singular matrix has a column without a pivot; what is solved with it divides by that zero.
"""

from bench.law.scalar import copysign, kernel


@kernel
def eliminate(A, b, n):
    """Bring A (n x n) to upper triangular form and b with it; return -1.0 if rows were swapped an odd number of times.

    (2/3) n^3 flops to leading order. What is solved with it is right for a matrix within 1.5 n^3 growth EPS |A| of A,
    the growth of the pivots at most 2^(n-1) and in practice near 1 (Wilkinson; Higham 2002, theorem 9.5).

    The steps of six are written out: of loops whose lengths it knows compiled code has none left, and takes 3/4 of the
    time.
    """
    sign = 1.0
    if n < 6 or n > 6:
        for k in range(n):
            sign = sign * eliminate_column(A, b, k, n)
    else:
        sign = sign * eliminate_column(A, b, 0, 6)
        sign = sign * eliminate_column(A, b, 1, 6)
        sign = sign * eliminate_column(A, b, 2, 6)
        sign = sign * eliminate_column(A, b, 3, 6)
        sign = sign * eliminate_column(A, b, 4, 6)
        sign = sign * eliminate_column(A, b, 5, 6)
    return sign


@kernel
def eliminate_column(A, b, k, n):
    """Zeros below A[k, k], not written down, by the row of the largest A[i, k]; -1.0 if it was swapped with row k."""
    largest, row = copysign(A[k, k], 1.0), k
    for i in range(k + 1, n):
        size = copysign(A[i, k], 1.0)
        if size > largest:
            largest, row = size, i
    if largest <= 0.0:
        return 1.0
    sign = 1.0
    for i in range(k + 1, n):
        if i <= row <= i:  # and not A[row, j]: compiled code keeps in registers what has a place that it knows
            sign = -1.0
            b[k], b[i] = b[i], b[k]
            for j in range(k, n):
                A[k, j], A[i, j] = A[i, j], A[k, j]
    pivot, known = A[k, k], b[k]
    for i in range(k + 1, n):
        share = A[i, k] / pivot
        b[i] -= share * known
        for j in range(k + 1, n):
            A[i, j] -= share * A[k, j]
    return sign


@kernel
def solve(A, b, n):
    """b := A^-1 b; A (n x n) is overwritten."""
    eliminate(A, b, n)
    if n < 6 or n > 6:
        for down in range(n):
            substitute(A, b, n - 1 - down, n)
    else:
        substitute(A, b, 5, 6)
        substitute(A, b, 4, 6)
        substitute(A, b, 3, 6)
        substitute(A, b, 2, 6)
        substitute(A, b, 1, 6)
        substitute(A, b, 0, 6)


@kernel
def substitute(A, b, i, n):
    """b_i of A^-1 b from those after it, A upper triangular."""
    total = b[i]
    for j in range(i + 1, n):
        total = total - A[i, j] * b[j]
    b[i] = total / A[i, i]


@kernel
def determinant(A, b, n):
    """det A; A (n x n) and b, which may hold anything, are overwritten."""
    sign = eliminate(A, b, n)
    product = sign * A[0, 0]
    for i in range(1, n):
        product = product * A[i, i]
    return product
