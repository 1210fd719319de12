"""The pseudo-inverse x = J^+ a by the normal equations: of all x that fit a best, the shortest.

On more joints than rows J^T (J J^T)^-1 a; with a quaternion's seven rows on six joints (J^T J)^-1 J^T a, where the part
of a that no motion can give lies along q alone and drops out, so that the answer depends on no unit.

Limitations: as `solve` does where J loses rank, and sooner: the equations square the condition number, so that beyond
1e8 nothing is left of the digits.
"""

from functools import partial

from bench.law import PUBLISHED, Inverse, kernel, refuse_seven, smaller_gram, solve_gram


@kernel
def resolve(J, a, D, x, rows, n, scratch):
    """x = J^T (J J^T)^-1 a, or (J^T J)^-1 J^T a if the rows are more than the joints; by Cholesky's factors."""
    smaller_gram(J, scratch.A, rows, n)
    for i in range(rows):
        scratch.s[i] = a[i]
    solve_gram(J, scratch.s, scratch.A, x, rows, n)


INVERSE = Inverse(
    name="pseudo-inverse",
    title="Pseudo-inverse",
    source="Whitney 1972; also Penrose 1955",
    attribution=PUBLISHED,
    formula=r"\ddot q = J^{+} a, \quad J^{+} = J^\top (J J^\top)^{-1} \text{ or } (J^\top J)^{-1} J^\top",
    resolve=resolve,
    refuses=partial(refuse_seven, ": both J J^T and J^T J are singular"),
)
