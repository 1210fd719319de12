"""Operational space with a bound on the condition number of Lambda: its great eigenvalues are clamped.

Eigenvalues of Lambda^-1 below the greatest over CONDITION are raised to it, as IsaacLab#7063 proposes. There the bound
is a setting; CONDITION is the ratio at which the rule that was merged instead (operational-damped) begins.

Limitations: below the bound the motion is weaker than commanded, in the singular direction 0.
"""

from bench.law import ADAPTED, Inverse, kernel
from bench.law.operational_space import compose, decompose, eigenvalue, greatest_eigenvalue

CONDITION = 1e4


@kernel
def resolve(J, a, D, x, rows, n, scratch):
    """x = J^T Lambda a, no eigenvalue of Lambda above CONDITION times the least."""
    decompose(J, a, D, rows, n, scratch)
    least = greatest_eigenvalue(rows, n, scratch) / CONDITION
    for i in range(rows):
        scratch.s[i] = scratch.s[i] / max(least, eigenvalue(i, n, scratch))
    compose(D, x, rows, n, scratch)


INVERSE = Inverse(
    name="operational-clamped",
    title="Operational space, clamped",
    source="after isaac-sim/IsaacLab#7063 (its text read); the bound 10,000 is ours",
    attribution=ADAPTED,
    formula=r"\tau = J^\top \Lambda a, \quad \lambda_i = 1 / \max(\sigma_i^2,\; \sigma_{\max}^2 / \kappa)",
    resolve=resolve,
    gives="torque",
    uses_inertia=True,
)
