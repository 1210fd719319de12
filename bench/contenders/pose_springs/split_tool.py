"""Position in the tool's axes and the logarithm of the rotation: stiffness along the tool, each for itself.

    f = -K R^T p        m = -kr phi

Fails: unless K = k I it is no spring; the moment that turning K with the tool takes is missing.
"""

from bench.law import PoseSpring, from_quaternion, kernel, rotate_back, rotation_vector, times


@kernel
def wrench(q, p, K, kr):
    """(-K R^T p, -kr phi)."""
    f, phi = times(K, rotate_back(from_quaternion(q), p)), rotation_vector(q)
    return (-f[0], -f[1], -f[2]), (-kr * phi[0], -kr * phi[1], -kr * phi[2])


POSE_SPRING = PoseSpring(
    "split-tool",
    "Split: position in the tool's axes, logarithm",
    "",
    r"-K R^\top p,\ -k_r\phi",
    wrench,
)
