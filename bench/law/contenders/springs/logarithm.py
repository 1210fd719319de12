"""Kr times the logarithm: linear in the angle about every eigenvector of Kr, and no spring unless Kr = k I.

Limitations: where Kr has different eigenvalues its work over a closed path is not zero; jumps at 180 degrees.
"""

from bench.law import AT_REST, Spring, kernel, rotation_vector, times


@kernel
def wrench(q, p, K, Kr):
    """Return (0, -Kr phi)."""
    e = times(Kr, rotation_vector(q))
    return AT_REST, (-e[0], -e[1], -e[2])


SPRING = Spring(
    "logarithm", "K times the logarithm", "", r"-K\phi", wrench, is_rotational=True, frames=("tool", "goal")
)
