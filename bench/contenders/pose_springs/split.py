"""Position in the goal's axes and the logarithm of the rotation, each for itself: what most controllers run.

    f = -R^T K p        m = -kr phi        U = p^T K p/2 + kr |phi|^2/2

Fails: the hand's origin goes straight, and so where that origin is drawn decides how the hand moves.
"""

from bench.law import PoseSpring, dot, from_quaternion, kernel, rotate_back, rotation_vector, times


@kernel
def wrench(q, p, K, kr):
    """(-R^T K p, -kr phi)."""
    f, phi = rotate_back(from_quaternion(q), times(K, p)), rotation_vector(q)
    return (-f[0], -f[1], -f[2]), (-kr * phi[0], -kr * phi[1], -kr * phi[2])


@kernel
def potential(q, p, K, kr):
    """p^T K p/2 + kr |phi|^2/2 [J]."""
    phi = rotation_vector(q)
    return 0.5 * dot(p, times(K, p)) + 0.5 * kr * dot(phi, phi)


POSE_SPRING = PoseSpring(
    "split",
    "Split: position in the goal's axes, logarithm",
    "Khatib 1987; libfranka, impedance example",
    r"-R^\top K p,\ -k_r\phi",
    wrench,
    potential,
)
