"""Kr times twice the quaternion's vector part: the stiffness that is set, and no spring unless Kr = k I.

Limitations: where Kr has different eigenvalues its work over a closed path is not zero.
"""

from bench.law import AT_REST, Spring, kernel, times


@kernel
def wrench(q, p, K, Kr):
    """Return (0, -2 Kr eps)."""
    e = times(Kr, (q[1], q[2], q[3]))
    return AT_REST, (-2.0 * e[0], -2.0 * e[1], -2.0 * e[2])


SPRING = Spring(
    "double-vector-part",
    "K times twice the vector part",
    "",
    r"-2K\epsilon",
    wrench,
    is_rotational=True,
    frames=("tool", "goal"),
)
