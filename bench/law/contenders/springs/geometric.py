"""Geometric impedance on SE(3), by the potential p^T K p/2 + Kr (1 - cos theta), the same seen from every base.

    f = -R^T K p        m = -Kr sin(theta) k

Limitations: at exact 180° rotations the moment is zero; the hand's origin decides how the hand moves, as it does where
the spring is split.

Source: Bullo, Murray 1999, Tracking for fully actuated mechanical systems: a geometric framework; Seo, Prakash, Rose,
Choi, Horowitz 2023, Geometric impedance control on SE(3) for robotic manipulators.
"""

from bench.law import Spring, dot, from_quaternion, kernel, rotate_back, times


@kernel
def wrench(q, p, K, Kr):
    """Return (-R^T K p, -2 Kr eta eps)."""
    f, pull = rotate_back(from_quaternion(q), times(K, p)), -2.0 * Kr * q[0]
    return (-f[0], -f[1], -f[2]), (pull * q[1], pull * q[2], pull * q[3])


@kernel
def potential(q, p, K, Kr):
    """Return p^T K p/2 + 2 Kr |eps|^2 [J]."""
    eps = (q[1], q[2], q[3])
    return 0.5 * dot(p, times(K, p)) + 2.0 * Kr * dot(eps, eps)


SPRING = Spring(
    "geometric",
    "Geometric: position in the goal's axes, sine",
    "Bullo & Murray 1999; Seo and others 2023",
    r"-R^\top K p,\ -k_r\sin\theta\,k",
    wrench,
    potential,
)
