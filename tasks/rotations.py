"""Quaternions of the starts and goals, exact where doubles can be exact.

Unit quaternions (w, x, y, z), body to base. The functions of half an angle are arranged so that 0, +-pi/2 and
+-pi come out exact: cos(theta/2) is computed as sin((pi - |theta|)/2), which is 1 at 0, equal to sin(theta/2)
bit for bit at pi/2, and 0 at `math.pi`. Elsewhere the rounding is that of the double given as the angle.
"""

from __future__ import annotations

import itertools
import math

from tasks.base import Quat, Vector


def multiply(p: Quat, q: Quat) -> Quat:
    """Return the Hamilton product p * q: first q, then p (base frame)."""
    return (
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
        p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
        p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0],
    )


def columns(q: Quat) -> tuple[Vector, Vector, Vector]:
    """Return the columns n, o, a of R(q), by the formula and in the order of operations of MuJoCo's mju_quat2Mat.

    It is bit for bit the site matrix of a free body of this orientation, so that "exactly on the pole" is decided here.
    """
    w, x, y, z = q
    ww, xx, yy, zz = w * w, x * x, y * y, z * z
    return (
        (ww + xx - yy - zz, 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)),
        (2.0 * (x * y - w * z), ww - xx + yy - zz, 2.0 * (y * z + w * x)),
        (2.0 * (x * z + w * y), 2.0 * (y * z - w * x), ww - xx - yy + zz),
    )


def to_body(q: Quat, v: Vector) -> Vector:
    """R(q)^T v: base coordinates to body coordinates."""
    x, y, z = (column[0] * v[0] + column[1] * v[1] + column[2] * v[2] for column in columns(q))
    return (x, y, z)


def to_base(q: Quat, v: Vector) -> Vector:
    """R(q) v: body coordinates to base coordinates."""
    n, o, a = columns(q)
    x, y, z = (v[0] * n[i] + v[1] * o[i] + v[2] * a[i] for i in range(3))
    return (x, y, z)


def unit(v: Vector) -> Vector:
    """Return the vector v / |v|."""
    length = math.hypot(*v)
    return (v[0] / length, v[1] / length, v[2] / length)


def about(axis: Vector, theta: float) -> Quat:
    """Rotation by theta [rad] in [-pi, pi] about an axis, which need not be of unit length."""
    c, s = _half(theta)
    x, y, z = unit(axis)
    return (c, s * x, s * y, s * z)


def short_of_180_degrees(axis: Vector, delta: float) -> Quat:
    """Rotation by pi - delta [rad] about an axis.

    w = sin(delta/2) has full relative precision for any delta, which pi - delta rounded to a double has not;
    delta = 0 gives w = 0 and a symmetric R, whose rotation-matrix error (2.12) is exactly zero.
    """
    x, y, z = unit(axis)
    s = math.cos(delta / 2.0)
    return (math.sin(delta / 2.0), s * x, s * y, s * z)


def zyx(alpha: float, beta: float, gamma: float) -> Quat:
    """Z-Y-X Euler angles, R = Rz(alpha) Ry(beta) Rx(gamma), each in [-pi, pi] (Murphy 1988, section 2.2)."""
    (ca, sa), (cb, sb), (cg, sg) = _half(alpha), _half(beta), _half(gamma)
    return multiply((ca, 0.0, 0.0, sa), multiply((cb, 0.0, sb, 0.0), (cg, sg, 0.0, 0.0)))


# How far on_pole searches, in last places. The squares must add up to 1/2 on its grid of 2^-54: one last
# place of the larger number moves its square by about as much, so a few are enough; the square of a number
# half as large has two more bits to be rid of, and so on down to sin(0.05) or so, where the search gives up.
LARGER_PLACES = 4
SMALLER_PLACES = 256


def on_pole(sign: int, twist: float) -> Quat:
    """Return the orientation with beta = sign pi/2 and n = (0, 0, -sign), where B is singular (Murphy 1988, 2.8).

    twist [rad]: alpha - gamma at +pi/2, alpha + gamma at -pi/2, all that is determined there. The pattern
    (c, -sign s, sign c, s) / sqrt(2), c and s of twist/2, makes n_y vanish exactly; n_x vanishes for those doubles next
    to it for which (w^2 + x^2) - y^2 - z^2 rounds to 0. Of these the nearest with |n_z| = 1 is taken, or else |n_z|
    nearest 1. If c or s is zero there is none: sqrt(1/2) gives n_z = -sign (1 + 2.2e-16).

    Limitations: ArithmeticError for some twists within 0.2 rad of 0 or +-pi but not on them.
    """
    c, s = _half(twist)
    a, b = c * math.sqrt(0.5), s * math.sqrt(0.5)
    spread_a, spread_b = (SMALLER_PLACES, LARGER_PLACES) if abs(a) < abs(b) else (LARGER_PLACES, SMALLER_PLACES)
    best: tuple[float, Quat] | None = None
    for p, q in itertools.product(_neighbours(a, spread_a), _neighbours(b, spread_b)):
        quat = (p, -sign * q + 0.0, sign * p + 0.0, q)  # + 0.0: no negative zeros
        n = columns(quat)[0]
        if n[0] == 0.0 and n[1] == 0.0:
            miss = abs(abs(n[2]) - 1.0)
            if miss == 0.0:
                return quat
            if best is None or miss < best[0]:
                best = (miss, quat)
    if best is None:
        raise ArithmeticError(f"no double near twist = {twist} has n exactly on the pole (try one further from 0)")
    return best[1]


def _half(theta: float) -> tuple[float, float]:
    """cos(theta/2), sin(theta/2) for theta in [-pi, pi], exact at 0 and +-math.pi, equal at pi/2."""
    size = abs(theta)
    return math.sin((math.pi - size) / 2.0), math.copysign(math.sin(size / 2.0), theta)


def _neighbours(x: float, places: int) -> list[float]:
    """Return the doubles within so many last places of x, nearest first; zero has none but itself."""
    offsets = sorted(range(-places, places + 1), key=abs) if x else [0]
    return [x + i * math.ulp(x) for i in offsets]
