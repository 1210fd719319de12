"""K times twice the quaternion's vector part: the stiffness that is set, and no spring unless K = k I.

Limitations: where K has different eigenvalues its work over a closed path is not zero.
"""

from bench.law import ADAPTED, Spring, kernel, times


@kernel
def moment(q, K):
    """Return -2 K eps."""
    e = times(K, (q[1], q[2], q[3]))
    return (-2.0 * e[0], -2.0 * e[1], -2.0 * e[2])


SPRING = Spring(
    "double-vector-part",
    "K times twice the vector part",
    "after libfranka, impedance example, with a factor 2",
    r"-2K\epsilon",
    moment,
    frames=("tool", "goal"),
    attribution=ADAPTED,
)
