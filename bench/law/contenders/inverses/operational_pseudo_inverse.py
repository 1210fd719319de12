"""Operational space with the pseudo-inverse of a singular Lambda^-1, by the rule of mjctrl.

If |det Lambda^-1| is at least SINGULAR, Lambda is the inverse. If it is smaller, eigenvalues of Lambda^-1 below
TOLERANCE times the greatest are left out. (numpy.linalg.pinv without a tolerance, as in robosuite, leaves out 1e-15 of
the greatest: beside a singularity that is the inverse.)

Limitations: at both thresholds the torque jumps; along the directions left out there is none.
"""

from bench.law import PUBLISHED, Inverse, kernel
from bench.law.operational_space import compose, decompose, eigenvalue, greatest_eigenvalue

SINGULAR, TOLERANCE = 1e-2, 1e-2


@kernel
def resolve(J, a, D, x, rows, n, scratch):
    """x = J^T (J D^-1 J^T)^+ a."""
    decompose(J, a, D, rows, n, scratch)
    determinant = 1.0
    for i in range(rows):
        determinant = determinant * eigenvalue(i, n, scratch)
    least = TOLERANCE * greatest_eigenvalue(rows, n, scratch) if determinant < SINGULAR else 0.0
    for i in range(rows):
        square = eigenvalue(i, n, scratch)
        scratch.s[i] = scratch.s[i] / square if square > least else 0.0
    compose(D, x, rows, n, scratch)


INVERSE = Inverse(
    name="operational-pseudo-inverse",
    title="Operational space, pseudo-inverse",
    source="kevinzakka/mjctrl, opspace.py; also Khatib 1987",
    attribution=PUBLISHED,
    formula=r"\tau = J^\top (J D^{-1} J^\top)^{+} a",
    resolve=resolve,
    gives="torque",
    uses_inertia=True,
)
