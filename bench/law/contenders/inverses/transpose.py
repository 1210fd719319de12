"""The Jacobian's transpose in place of an inverse: tau = J^T a, as if a were the force and moment on the tool.

The force that would give a unit mass of unit inertia the acceleration a. It needs no inverse and exists everywhere, but
the arm is no unit mass: it does not linearize, its stiffness depends on the pose, and only rest at the goal is kept.

Limitations: the motion is that of another plant, slower or faster by the arm's own inertia.
"""

from bench.law import PUBLISHED, Inverse, kernel, multiply_transposed


@kernel
def resolve(J, a, D, x, rows, n, scratch):
    """x = J^T a, unit mass and inertia taken for the arm's."""
    multiply_transposed(J, a, x, rows, n)


INVERSE = Inverse(
    name="transpose",
    title="Transpose",
    source="Takegaki & Arimoto 1981; also Craig 1986",
    attribution=PUBLISHED,
    formula=r"\tau = J^\top a",
    resolve=resolve,
    gives="torque",
)
