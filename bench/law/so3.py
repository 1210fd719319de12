"""Rotations as three columns, vectors as three numbers.

R = [n o a] (Murphy 1988, 2.4-2.5): n, o, a are the body's axes in the base frame. All vectors are in the base frame
unless a name ends in `_body`.
"""

from typing import NamedTuple

from bench.law.scalar import kernel


class Rotation(NamedTuple):
    """A rotation matrix by its columns (Murphy 1988, 2.4); each column is a tuple of three numbers."""

    n: tuple
    o: tuple
    a: tuple


IDENTITY = Rotation((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@kernel
def cross(p, q):
    """p x q."""
    return (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])


@kernel
def dot(p, q):
    """p . q."""
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]


@kernel
def minus(p, q):
    """p - q."""
    return (p[0] - q[0], p[1] - q[1], p[2] - q[2])


@kernel
def spring_damper(k, e, kv, omega):
    """k e - Kv omega: a spring along e, and the damper that nearly all laws share."""
    return (k * e[0] - kv * omega[0], k * e[1] - kv * omega[1], k * e[2] - kv * omega[2])


@kernel
def rotate(R, v):
    """R v: the base-frame vector whose body-frame components are v."""
    return (
        R.n[0] * v[0] + R.o[0] * v[1] + R.a[0] * v[2],
        R.n[1] * v[0] + R.o[1] * v[1] + R.a[1] * v[2],
        R.n[2] * v[0] + R.o[2] * v[1] + R.a[2] * v[2],
    )


@kernel
def rotate_back(R, v):
    """R^T v: the body-frame components of the base-frame vector v."""
    return (dot(R.n, v), dot(R.o, v), dot(R.a, v))


@kernel
def relative(R_d, R):
    """R_d^T R: the orientation R seen from the goal R_d."""
    return Rotation(rotate_back(R_d, R.n), rotate_back(R_d, R.o), rotate_back(R_d, R.a))


@kernel
def double_sine(R, R_d):
    """n x n_d + o x o_d + a x a_d = 2 sin(theta) k, base frame: theta k is the turn from R to R_d."""
    n, o, a = cross(R.n, R_d.n), cross(R.o, R_d.o), cross(R.a, R_d.a)
    return (n[0] + o[0] + a[0], n[1] + o[1] + a[1], n[2] + o[2] + a[2])


@kernel
def trace(R, R_d):
    """tr(R_d^T R) = 1 + 2 cos(theta)."""
    return dot(R.n, R_d.n) + dot(R.o, R_d.o) + dot(R.a, R_d.a)


@kernel
def half_cosine_squared(R, R_d):
    """cos^2(theta/2) = (1 + tr(R_d^T R))/4: 0 exactly on 180° rotations."""
    return 0.25 * (1.0 + trace(R, R_d))


@kernel
def turn_matrix(R, R_d):
    """E = R_d R^T = exp(theta [k]x): the turn from R to R_d, base frame."""
    return Rotation(
        rotate(R_d, (R.n[0], R.o[0], R.a[0])),
        rotate(R_d, (R.n[1], R.o[1], R.a[1])),
        rotate(R_d, (R.n[2], R.o[2], R.a[2])),
    )


@kernel
def turn_quaternion(R, R_d):
    """(w, (x, y, z), t): the quaternion of the turn from R to R_d, base frame, of length 2 sqrt(t), t >= 1, w >= 0.

    Its vector part is 2 sqrt(t) sin(theta/2) k. At 180° see `quaternion_direction`.
    """
    (w, x, y, z), t = quaternion_direction(turn_matrix(R, R_d))
    return w, (x, y, z), t


@kernel
def from_quaternion(quat_wxyz):
    """Rotation of a unit quaternion (w, x, y, z).

    The diagonal is written w^2 + x^2 - y^2 - z^2 as MuJoCo does: at the pole (w = y, x = z = 0) it is exactly zero,
    which 1 - 2 (y^2 + z^2) is not.
    """
    w, x, y, z = quat_wxyz
    return Rotation(
        (w * w + x * x - y * y - z * z, 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)),
        (2.0 * (x * y - w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z + w * x)),
        (2.0 * (x * z + w * y), 2.0 * (y * z - w * x), w * w - x * x - y * y + z * z),
    )


@kernel
def quaternion_direction(R):
    """((w, x, y, z), t): the quaternion of R with w >= 0, of length 2 sqrt(t), t >= 1; no root is taken.

    One of its four elements is t itself, 4 times the square of that element of the unit quaternion, and the branches
    choose one that is at least 1/2 there: nothing cancels, at 180° rotations neither. Where w is 0 that element is
    positive; where w is 0 but for rounding, its sign is the rounding's.
    Source: Shepperd 1978, with the two comparisons of Day (Converting a rotation matrix to a quaternion).
    """
    n, o, a = R
    if a[2] < 0.0:
        if n[0] > o[1]:
            t = 1.0 + n[0] - o[1] - a[2]
            w, x, y, z = o[2] - a[1], t, n[1] + o[0], a[0] + n[2]
        else:
            t = 1.0 - n[0] + o[1] - a[2]
            w, x, y, z = a[0] - n[2], n[1] + o[0], t, o[2] + a[1]
    elif n[0] < -o[1]:
        t = 1.0 - n[0] - o[1] + a[2]
        w, x, y, z = n[1] - o[0], a[0] + n[2], o[2] + a[1], t
    else:
        t = 1.0 + n[0] + o[1] + a[2]
        w, x, y, z = t, o[2] - a[1], a[0] - n[2], n[1] - o[0]
    if w < 0.0:
        w, x, y, z = -w, -x, -y, -z
    return (w, x, y, z), t


@kernel
def driven(m, inertia, spring, kv, omega):
    """Compute the resulting angular acceleration, m/m_o + spring - Kv omega."""
    return (
        m[0] / inertia + spring[0] - kv * omega[0],
        m[1] / inertia + spring[1] - kv * omega[1],
        m[2] / inertia + spring[2] - kv * omega[2],
    )
