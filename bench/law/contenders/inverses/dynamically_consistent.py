"""Operational space: tau = J^T Lambda a, Lambda = (J D^-1 J^T)^-1 the inertia seen at the tool (Khatib 1987).

On six joints it is D J^-1 a. On seven it is the torque of least kinetic energy, and leaves alone what the tool does not
see. From D = L L^T and Y = L^-1 J^T, Lambda^-1 = Y^T Y, so that D is never inverted.

Limitations: where J loses rank Lambda is not finite; like pseudo-inverse it squares the condition number of J.
"""

from bench.law import PUBLISHED, Inverse, factor, gram, kernel, multiply_transposed, solve_factored
from bench.law.operational_space import whiten


@kernel
def resolve(J, a, D, x, rows, n, scratch):
    """x = J^T (J D^-1 J^T)^-1 a; by Cholesky's factors, twice."""
    S, force = scratch.A, scratch.s
    whiten(J, D, rows, n, scratch)
    gram(scratch.V, S, rows, n)
    factor(S, rows)
    for i in range(rows):
        force[i] = a[i]
    solve_factored(S, force, rows)
    multiply_transposed(J, force, x, rows, n)


def refuses(rows: int, n: int) -> str:
    """More rows than a rigid body has freedoms, or than the arm has joints."""
    if rows > 6 or rows > n:
        return (
            f"J D^-1 J^T of a {rows} x {n} Jacobian is singular, so Lambda does not exist; "
            "use coordinates of three numbers on six joints or more, or damped-least-squares"
        )
    return ""


INVERSE = Inverse(
    name="dynamically-consistent",
    title="Dynamically consistent",
    source="Khatib 1987",
    attribution=PUBLISHED,
    formula=r"\tau = J^\top \Lambda\, a, \quad \Lambda = (J D^{-1} J^\top)^{-1}",
    resolve=resolve,
    gives="torque",
    refuses=refuses,
    uses_inertia=True,
)
