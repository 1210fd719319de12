"""Position in the tool's axes and the logarithm of the rotation: stiffness along the tool.

    f = -K R^T p        m = -Kr phi

Limitations: unless K = k I it is no spring; the moment that turning K with the tool takes is missing.
"""

from bench.law import Spring, from_quaternion, kernel, rotate_back, rotation_vector, times


@kernel
def wrench(q, p, K, Kr):
    """Return (-K R^T p, -Kr phi)."""
    f, phi = times(K, rotate_back(from_quaternion(q), p)), rotation_vector(q)
    return (-f[0], -f[1], -f[2]), (-Kr * phi[0], -Kr * phi[1], -Kr * phi[2])


SPRING = Spring(
    "split-tool",
    "Split: position in the tool's axes, logarithm",
    "",
    r"-K R^\top p,\ -k_r\phi",
    wrench,
)
