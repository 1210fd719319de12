"""K times the quaternion's vector part: half of the stiffness that is set, and no spring unless K = k I.

Franka's example, deoxys and others run it with a diagonal K. In the goal's axes and in the tool's the same three
numbers are two springs.

Limitations: where K has different eigenvalues its work over a closed path is not zero.
"""

from bench.law import PUBLISHED, Spring, kernel, times


@kernel
def moment(q, K):
    """Return -K eps."""
    e = times(K, (q[1], q[2], q[3]))
    return (-e[0], -e[1], -e[2])


SPRING = Spring(
    "vector-part",
    "K times the vector part",
    "libfranka, impedance example",
    r"-K\epsilon",
    moment,
    frames=("tool", "goal"),
    stiffness=0.5,
    attribution=PUBLISHED,
)
