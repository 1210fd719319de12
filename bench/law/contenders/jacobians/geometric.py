"""The Jacobian of the tool's velocity and angular velocity, both in the base frame (Murphy 1988, 2.2).

Limitations: it loses rank where the arm itself is singular.
"""

from bench.law import PUBLISHED, Jacobian, cross, kernel


@kernel
def fill(J, chain):
    """J_i = [z_i x (p - p_i); z_i]."""
    axes, anchors, p = chain.axes, chain.anchors, chain.p
    for i in range(chain.n):
        z = (axes[i, 0], axes[i, 1], axes[i, 2])
        swept = cross(z, (p[0] - anchors[i, 0], p[1] - anchors[i, 1], p[2] - anchors[i, 2]))
        for k in range(3):
            J[k, i] = swept[k]
            J[3 + k, i] = z[k]


@kernel
def express(chain, a):
    """Return the acceleration as it is: J is in the base frame."""
    return a


JACOBIAN = Jacobian(
    name="geometric",
    title="Geometric",
    source="Whitney 1972; also Murphy 1988, (2.2)",
    attribution=PUBLISHED,
    formula=r"J_i = \begin{pmatrix} z_i \times (p - p_i) \\ z_i \end{pmatrix}",
    takes="angular-acceleration",
    kernels_in=lambda representation: (fill, express),
)
