"""Kernels that springs of an orientation share."""

from bench.law.scalar import atan2, kernel, sqrt
from bench.law.so3 import cross, dot


@kernel
def times(K, v):
    """Compute K v of a matrix by rows."""
    return (
        K[0][0] * v[0] + K[0][1] * v[1] + K[0][2] * v[2],
        K[1][0] * v[0] + K[1][1] * v[1] + K[1][2] * v[2],
        K[2][0] * v[0] + K[2][1] * v[1] + K[2][2] * v[2],
    )


@kernel
def rotation_vector(q):
    """Compute theta k of a unit quaternion with w >= 0 [rad]."""
    length = sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
    s = 2.0 * atan2(length, q[0]) / length if length > 0.0 else 2.0
    return (s * q[1], s * q[2], s * q[3])


@kernel
def divide_by_left_jacobian(q, phi, v):
    """Compute (I - [phi]x/2 + b [phi]x^2) v, b = (1 - (theta/2) cot(theta/2))/theta^2, phi the rotation vector of q.

    b is its series below 0.01 rad, whose next term, theta^4/30240, is then under 4e-13.
    """
    squared = dot(phi, phi)
    b = 1.0 / 12.0 + squared / 720.0
    if squared > 1e-4:
        length = sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
        b = (1.0 - 0.5 * sqrt(squared) * q[0] / length) / squared
    c = cross(phi, v)
    d = cross(phi, c)
    return (v[0] - 0.5 * c[0] + b * d[0], v[1] - 0.5 * c[1] + b * d[1], v[2] - 0.5 * c[2] + b * d[2])
