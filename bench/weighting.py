"""What counts as a large motion of the joints: one length, one gain, shared by the inverses that bound their answer.

A singular value of J mixes metres and radians, so a bound on it depends on the unit of length. LENGTH makes it one of
a pure number: J_W = W J, its translations divided by LENGTH. Rows of orientation count as they are, in radians of the
angular velocity or of the coordinates.
"""

from bench.scalar import kernel

LENGTH = 0.5
"""[m]. About half the reach of the arms here (0.85 to 0.9 m): a turn of 1 rad then weighs as much as moving the tool by
what the same turn at half reach would move it."""

GREATEST_GAIN = 10.0
"""Joint acceleration [rad/s^2] for each unit of W a, [rad/s^2] or [LENGTH/s^2], at most. Every threshold of damping and
truncation is derived from it, so that the inverses can be compared: each keeps |x| <= GREATEST_GAIN |W a|. Well inside
the workspace an arm asks for 1 to 5; at 10 it is within a tenth of a radian of a singularity."""


@kernel
def weigh(J, a, J_W, a_W, rows, n):
    """J_W = W J and a_W = W a, W = diag(1/LENGTH, 1/LENGTH, 1/LENGTH, 1, ...)."""
    scale = 1.0 / LENGTH
    for i in range(3):
        a_W[i] = scale * a[i]
        for j in range(n):
            J_W[i, j] = scale * J[i, j]
    for i in range(3, rows):
        a_W[i] = a[i]
        for j in range(n):
            J_W[i, j] = J[i, j]
