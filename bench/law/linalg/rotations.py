"""One-sided Jacobi rotations of the rows of a matrix: its singular value decomposition (Hestenes 1958).

U^T A has orthogonal rows sigma_i v_i^T, so that with U^T b beside them the decomposition is complete and neither U nor
V need be formed: A^+ b is the sum of (U^T b)_i / sigma_i^2 times row i.

Two rows p, q count as orthogonal where |p . q| <= n EPS |p| |q|: the rounding of a scalar product of n terms is half of
that, so that no rotation could make it surely smaller. A row shorter than n EPS |A| (Frobenius) is zero to rounding and
left alone: of dependent rows one would else shrink by a factor of EPS in every sweep and be orthogonal to none. Both
are compared by squares, which are neither zero nor infinite for matrices of the size 1e-77 to 1e77.

Each sweep rotates every pair once; the angles left go down quadratically once they are small. 6 x 6 and 6 x 7 matrices,
Jacobians and random ones of any rank, need 8 sweeps at most; SWEEPS is a bound for the loop, no setting.

Limitations: rows that are not finite are never rotated; they and what they stand for stay as they are.
"""

from bench.law.scalar import copysign, kernel, sqrt

SWEEPS = 16
EPS_SQUARED = 2.0**-104


@kernel
def orthogonalize(A, b, rows, n):
    """Return a := U^T A with orthogonal rows, b := U^T b; A of rows x n and any rank. Returns the sweeps it took.

    The rows are in no order; one that stands for a singular value of zero is zero to rounding of the largest.
    """
    nearly = EPS_SQUARED * (n * n)
    square = A[0, 0] * A[0, 0]
    for k in range(1, n):
        square = square + A[0, k] * A[0, k]
    for i in range(1, rows):
        for k in range(n):
            square = square + A[i, k] * A[i, k]
    zero = nearly * square
    sweeps = 0
    for sweep in range(SWEEPS):
        sweeps = sweep + 1
        turned = 0
        for p in range(rows - 1):
            for q in range(p + 1, rows):
                pp = A[p, 0] * A[p, 0]
                qq = A[q, 0] * A[q, 0]
                pq = A[p, 0] * A[q, 0]
                for k in range(1, n):
                    pp = pp + A[p, k] * A[p, k]
                    qq = qq + A[q, k] * A[q, k]
                    pq = pq + A[p, k] * A[q, k]
                if pp > zero and qq > zero and pq * pq > nearly * (pp * qq):
                    turned = 1
                    zeta = (qq - pp) / (2.0 * pq)
                    tangent = copysign(1.0, zeta) / (copysign(zeta, 1.0) + sqrt(1.0 + zeta * zeta))
                    c = 1.0 / sqrt(1.0 + tangent * tangent)
                    s = c * tangent
                    for k in range(n):
                        above, below = A[p, k], A[q, k]
                        A[p, k] = c * above - s * below
                        A[q, k] = s * above + c * below
                    above, below = b[p], b[q]
                    b[p] = c * above - s * below
                    b[q] = s * above + c * below
        if turned < 1:
            break
    return sweeps
