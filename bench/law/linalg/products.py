"""Matrix times vector, and a matrix times its transpose, of which the lower half is all that is needed."""

from bench.law.scalar import kernel


@kernel
def multiply(A, x, y, rows, n):
    """y = A x, A of rows x n; rows of six in a loop whose length compiled code knows."""
    for i in range(rows):
        y[i] = dot_row(A, x, i, n) if n < 6 or n > 6 else dot_row(A, x, i, 6)


@kernel
def dot_row(A, x, i, n):
    """Row i of A times x."""
    total = A[i, 0] * x[0]
    for j in range(1, n):
        total = total + A[i, j] * x[j]
    return total


@kernel
def multiply_transposed(A, y, x, rows, n):
    """x = A^T y, A of rows x n."""
    for j in range(n):
        total = A[0, j] * y[0]
        for i in range(1, rows):
            total = total + A[i, j] * y[i]
        x[j] = total


@kernel
def dot_rows(A, i, B, j, n):
    """Row i of A times row j of B."""
    total = A[i, 0] * B[j, 0]
    for k in range(1, n):
        total = total + A[i, k] * B[j, k]
    return total


@kernel
def gram(A, S, rows, n):
    """S = A A^T (rows x rows): its lower half, i >= j; the upper one is left as it is."""
    for i in range(rows):
        for j in range(i + 1):
            S[i, j] = dot_rows(A, i, A, j, n)


@kernel
def gram_transposed(A, S, rows, n):
    """S = A^T A (n x n): its lower half, i >= j; the upper one is left as it is."""
    for i in range(n):
        for j in range(i + 1):
            total = A[0, i] * A[0, j]
            for k in range(1, rows):
                total = total + A[k, i] * A[k, j]
            S[i, j] = total
