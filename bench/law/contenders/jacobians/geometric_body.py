"""The geometric Jacobian in the tool's own frame: diag(R^T, R^T) J.

The same accelerations of the joints as from the base frame, with an exact inverse; a damped or truncated one differs
not either, as the weight on translations is the same in every direction.
Limitations: where the geometric one does.
"""

from bench.law import PUBLISHED, Jacobian, cross, kernel, rotate_back


@kernel
def fill(J, chain):
    """J_i = [R^T (z_i x (p - p_i)); R^T z_i]."""
    axes, anchors, p, R = chain.axes, chain.anchors, chain.p, chain.R
    for i in range(chain.n):
        z = rotate_back(R, (axes[i, 0], axes[i, 1], axes[i, 2]))
        r = rotate_back(R, (p[0] - anchors[i, 0], p[1] - anchors[i, 1], p[2] - anchors[i, 2]))
        swept = cross(z, r)
        for k in range(3):
            J[k, i] = swept[k]
            J[3 + k, i] = z[k]


@kernel
def express(chain, a):
    """diag(R^T, R^T) a."""
    linear = rotate_back(chain.R, (a[0], a[1], a[2]))
    angular = rotate_back(chain.R, (a[3], a[4], a[5]))
    return (linear[0], linear[1], linear[2], angular[0], angular[1], angular[2])


JACOBIAN = Jacobian(
    name="geometric-body",
    title="Geometric, tool frame",
    source="Whitney 1972; also Craig 1986",
    attribution=PUBLISHED,
    formula=r"\operatorname{diag}(R^\top, R^\top)\, J",
    takes="angular-acceleration",
    kernels_in=lambda representation: (fill, express),
)
