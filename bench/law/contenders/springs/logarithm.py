"""K times the logarithm: linear in the angle about every eigenvector of K, and no spring unless K = k I.

Limitations: where K has different eigenvalues its work over a closed path is not zero; jumps at 180 degrees.
"""

from bench.law import PUBLISHED, Spring, kernel, rotation_vector, times


@kernel
def moment(q, K):
    """Return -K phi."""
    e = times(K, rotation_vector(q))
    return (-e[0], -e[1], -e[2])


SPRING = Spring(
    "logarithm",
    "K times the logarithm",
    "Cartesian-Impedance-Controller (Mayr, Salt-Ducaju)",
    r"-K\phi",
    moment,
    frames=("tool", "goal"),
    attribution=PUBLISHED,
)
