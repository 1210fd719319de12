"""Kr times the quaternion's vector part: half of the stiffness that is set, and no spring unless Kr = k I.

Franka's example, deoxys and others run it with a diagonal Kr. In the goal's axes and in the tool's the same three
numbers are two springs.

Limitations: where Kr has different eigenvalues its work over a closed path is not zero.
"""

from bench.law import AT_REST, Spring, kernel, times


@kernel
def wrench(q, p, K, Kr):
    """Return (0, -Kr eps)."""
    e = times(Kr, (q[1], q[2], q[3]))
    return AT_REST, (-e[0], -e[1], -e[2])


SPRING = Spring(
    "vector-part",
    "K times the vector part",
    "libfranka, impedance example",
    r"-K\epsilon",
    wrench,
    is_rotational=True,
    frames=("tool", "goal"),
    stiffness=0.5,
)
