"""The spring of the potential U = phi^T K phi/2, phi the logarithm of X = R_d^T R.

phi' = J omega in the tool's axes with J = I + [phi]x/2 + b [phi]x^2, b = (1 - (theta/2) cot(theta/2))/theta^2, so that

    moment = -J^T K phi = -(K phi - phi x K phi/2 + b phi x (phi x K phi))

Limitations: jumps at 180 degrees.

Source: Bullo, Murray 1995, Proportional derivative control on the Euclidean group (differential of the logarithm).
"""

from bench.law import ADAPTED, Spring, divide_by_left_jacobian, dot, kernel, rotation_vector, times


@kernel
def moment(q, K):
    """Return -J^T K phi."""
    phi = rotation_vector(q)
    m = divide_by_left_jacobian(q, phi, times(K, phi))
    return (-m[0], -m[1], -m[2])


@kernel
def potential(q, K):
    """Return phi^T K phi/2 [J]."""
    phi = rotation_vector(q)
    return 0.5 * dot(phi, times(K, phi))


SPRING = Spring(
    "logarithm-energy",
    "Energy of the logarithm",
    "after Bullo and Murray 1995 (differential of the logarithm)",
    r"-J^\top K\phi",
    moment,
    potential,
    attribution=ADAPTED,
)
