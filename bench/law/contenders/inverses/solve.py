"""The inverse of a square Jacobian, by elimination: x = J^-1 a (Murphy 1988, 2.2, 3.7).

Limitations: where J is singular x is not finite, and towards it x grows like 1 / sigma_min(J) without bound.
"""

from bench.law import PUBLISHED, Inverse, kernel, refuse_seven, solve


@kernel
def resolve(J, a, D, x, rows, n, scratch):
    """J x = a by Gauss elimination with partial pivoting; J is 6 x 6, for `refuses` leaves no other."""
    A = scratch.A
    for i in range(6):
        x[i] = a[i]
        for j in range(6):
            A[i, j] = J[i, j]
    solve(A, x, 6)


def refuses(rows: int, n: int) -> str:
    """Anything but 6 x 6: a Jacobian has six rows, or seven."""
    if rows != n:
        return f"a {rows} x {n} Jacobian is not square; use pseudo-inverse, damped-least-squares or truncated-svd"
    return refuse_seven(", and no inverse", rows, n)


INVERSE = Inverse(
    name="solve",
    title="Inverse",
    source="Murphy 1988, (2.2), (3.7); also Luh, Walker, Paul 1980",
    attribution=PUBLISHED,
    formula=r"\ddot q = J^{-1} a",
    resolve=resolve,
    refuses=refuses,
)
