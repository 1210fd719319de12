"""Operational space with damping near singularities alone: the rule of IsaacLab since #7903.

To eigenvalues of Lambda^-1 of at most LOWER times the greatest, LOWER times the greatest is added before inversion; the
addition falls to zero at UPPER by 1 - 3 s^2 + 2 s^3, s from 0 at LOWER to 1 at UPPER.

Limitations: as operational-clamped. A weak direction takes at most 1 / (2 sqrt(LOWER)) = 158 times the torque of the
strongest one, clamped 100 times, each as |L^-1 tau| for the same acceleration.
"""

from bench.law import PUBLISHED, Inverse, kernel
from bench.law.operational_space import compose, decompose, eigenvalue, greatest_eigenvalue

LOWER, UPPER = 1e-5, 1e-4


@kernel
def resolve(J, a, D, x, rows, n, scratch):
    """x = J^T Lambda a, Lambda^-1 damped where its eigenvalues are small."""
    decompose(J, a, D, rows, n, scratch)
    greatest = greatest_eigenvalue(rows, n, scratch)
    for i in range(rows):
        square = eigenvalue(i, n, scratch)
        s = min(max((square / greatest - LOWER) / (UPPER - LOWER), 0.0), 1.0)
        scratch.s[i] = scratch.s[i] / (square + LOWER * greatest * (1.0 - s * s * (3.0 - 2.0 * s)))
    compose(D, x, rows, n, scratch)


INVERSE = Inverse(
    name="operational-damped",
    title="Operational space, damped",
    source="isaac-sim/IsaacLab#7903",
    attribution=PUBLISHED,
    formula=r"\tau = J^\top \Lambda a, \quad \lambda_i = 1 / (\sigma_i^2 + \delta(\sigma_i^2 / \sigma_{\max}^2))",
    resolve=resolve,
    gives="torque",
    uses_inertia=True,
)
