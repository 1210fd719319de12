"""Position in the goal's axes, and the logarithm of the rotation beside it: what most controllers run.

    f = -R^T K p        m = -Kr phi        U = p^T K p/2 + Kr |phi|^2/2

Limitations: the hand's origin goes straight, and so where that origin is drawn decides how the hand moves.
"""

from bench.law import Spring, dot, from_quaternion, kernel, rotate_back, rotation_vector, times


@kernel
def wrench(q, p, K, Kr):
    """Return (-R^T K p, -Kr phi)."""
    f, phi = rotate_back(from_quaternion(q), times(K, p)), rotation_vector(q)
    return (-f[0], -f[1], -f[2]), (-Kr * phi[0], -Kr * phi[1], -Kr * phi[2])


@kernel
def potential(q, p, K, Kr):
    """Return p^T K p/2 + Kr |phi|^2/2 [J]."""
    phi = rotation_vector(q)
    return 0.5 * dot(p, times(K, p)) + 0.5 * Kr * dot(phi, phi)


SPRING = Spring(
    "split",
    "Split: position in the goal's axes, logarithm",
    "Khatib 1987; libfranka, impedance example",
    r"-R^\top K p,\ -k_r\phi",
    wrench,
    potential,
)
