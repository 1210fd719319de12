"""The spring of the potential U = phi^T K phi/2, phi the logarithm of X = R_d^T R.

phi' = J omega in the tool's axes with J = I + [phi]x/2 + b [phi]x^2, b = (1 - (theta/2) cot(theta/2))/theta^2, so that

    moment = -J^T K phi = -(K phi - phi x K phi/2 + b phi x (phi x K phi))

Fails: jumps at 180 degrees.

Source: Bullo, Murray 1995, Proportional derivative control on the Euclidean group (differential of the logarithm).
"""

from bench.law import Spring, atan2, cross, dot, kernel, sqrt, times


@kernel
def logarithm(q):
    """phi of a unit quaternion with w >= 0 [rad]."""
    length = sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
    s = 2.0 * atan2(length, q[0]) / length if length > 0.0 else 2.0
    return (s * q[1], s * q[2], s * q[3])


@kernel
def moment(q, K):
    """-J^T K phi, in the tool's axes; b is its series below 0.01 rad."""
    phi = logarithm(q)
    e = times(K, phi)
    squared = dot(phi, phi)
    b = 1.0 / 12.0 + squared / 720.0
    if squared > 1e-4:
        length = sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
        b = (1.0 - 0.5 * sqrt(squared) * q[0] / length) / squared
    c = cross(phi, e)
    d = cross(phi, c)
    return (
        -(e[0] - 0.5 * c[0] + b * d[0]),
        -(e[1] - 0.5 * c[1] + b * d[1]),
        -(e[2] - 0.5 * c[2] + b * d[2]),
    )


@kernel
def potential(q, K):
    """phi^T K phi/2 [J]."""
    phi = logarithm(q)
    return 0.5 * dot(phi, times(K, phi))


SPRING = Spring(
    "logarithm-energy",
    "Energy of the logarithm",
    "Bullo and Murray 1995",
    r"-J^\top K\phi",
    moment,
    potential,
    ("tool",),
)
