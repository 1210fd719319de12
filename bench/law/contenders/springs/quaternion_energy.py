"""The spring of the potential U = 2 eps^T K eps.

eps' = (eta I + [eps]x) omega/2 in the tool's axes, so that U' = -moment . omega with

    moment = -2 (eta I - [eps]x) K eps

It is the trace form too, U = tr(G (I - R_d^T R)) with G = tr(K)/2 I - K (Bullo, Murray 1999), in quaternions.

Limitations: at 180 degrees about the eigenvectors of K it vanishes.

Source: Caccavale, Natale, Siciliano, Villani 1999, IEEE Transactions on Robotics and Automation 15(2), section IV.
"""

from bench.law import PUBLISHED, Spring, cross, dot, kernel, times


@kernel
def moment(q, K):
    """Return -2 (eta K eps - eps x K eps)."""
    eps = (q[1], q[2], q[3])
    e = times(K, eps)
    c = cross(eps, e)
    return (-2.0 * (q[0] * e[0] - c[0]), -2.0 * (q[0] * e[1] - c[1]), -2.0 * (q[0] * e[2] - c[2]))


@kernel
def potential(q, K):
    """Return 2 eps^T K eps [J]."""
    eps = (q[1], q[2], q[3])
    return 2.0 * dot(eps, times(K, eps))


SPRING = Spring(
    "quaternion-energy",
    "Energy of the quaternion",
    "Caccavale and others 1999",
    r"-2(\eta I - [\epsilon]_\times)K\epsilon",
    moment,
    potential,
    attribution=PUBLISHED,
)
