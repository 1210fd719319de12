"""K times the logarithm: linear in the angle about every eigenvector of K, and no spring unless K = k I.

Fails: where K has different eigenvalues its work over a closed way is not zero; jumps at 180 degrees.
"""

from bench.law import Spring, atan2, kernel, sqrt, times


@kernel
def moment(q, K):
    """-K phi, phi = 2 atan2(|eps|, eta) eps/|eps|."""
    length = sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
    s = 2.0 * atan2(length, q[0]) / length if length > 0.0 else 2.0
    e = times(K, (s * q[1], s * q[2], s * q[3]))
    return (-e[0], -e[1], -e[2])


SPRING = Spring("logarithm", "K times the logarithm", "", r"-K\phi", moment)
