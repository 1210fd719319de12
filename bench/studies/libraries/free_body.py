"""The free body of unit inertia, moved from Python one tick at a time: the plant of `ideal-held` for any callable.

omegadot = u held over the tick, Rdot = [omega]x R (Murphy 1988, 2.6-2.7). The goal is the identity, so that the error
that leads there is that of the rotation T = R^T. The quaternion of T is carried on continuously, as an encoder or an
integrator does, so that a function that takes quaternions sees the sign with which the episode began.
"""

import math
from collections.abc import Callable, Iterator

import numpy as np

from bench.engines.ideal import held_turn, plus
from bench.studies.libraries.library import QUATERNION, Function, answer

Quaternion = tuple[float, float, float, float]

AT_REST = (0.0, 0.0, 0.0)


def accelerated(function: Function, kp: float, kv: float, dt_s: float, quat_wxyz: Quaternion) -> Iterator[Quaternion]:
    """T tick by tick under u = kp e - kv omega, from rest; ends at once where nothing can ever move.

    Args:
        quat_wxyz: of T at the start, in either sign.
    """
    omega = AT_REST
    while True:
        yield quat_wxyz
        e = answer(function, np.array(quat_wxyz) if function.takes == QUATERNION else matrix(quat_wxyz))
        u = tuple(kp * float(part) - kv * rate for part, rate in zip(e, omega, strict=True))
        if u == AT_REST == omega:  # the same state and the same answer for ever
            return
        quat_wxyz = after(quat_wxyz, held_turn(omega, u, dt_s))
        omega = plus(omega, dt_s, u)


def driven(velocity: Callable, dt_s: float, quat_wxyz: Quaternion) -> Iterator[Quaternion]:
    """T tick by tick under a commanded angular velocity, velocity(T as 3 x 3) [rad/s, base frame], that is held."""
    while True:
        yield quat_wxyz
        omega = tuple(map(float, velocity(matrix(quat_wxyz))))
        if omega == AT_REST:
            return
        quat_wxyz = after(quat_wxyz, tuple(dt_s * part for part in omega))


def after(quat_wxyz: Quaternion, turn) -> Quaternion:
    """T exp(-[turn]x): what is left to go once the body has turned by the base-frame vector `turn`."""
    angle = math.hypot(*turn)
    if angle == 0.0:
        return quat_wxyz
    c, s = math.cos(0.5 * angle), -math.sin(0.5 * angle) / angle
    w, x, y, z = quat_wxyz
    a, b, d = s * turn[0], s * turn[1], s * turn[2]
    product = (
        w * c - x * a - y * b - z * d,
        x * c + w * a + y * d - z * b,
        y * c + w * b + z * a - x * d,
        z * c + w * d + x * b - y * a,
    )
    length = math.hypot(*product)
    return (product[0] / length, product[1] / length, product[2] / length, product[3] / length)


def matrix(quat_wxyz: Quaternion) -> np.ndarray:
    """R (3 x 3) of a unit quaternion; exactly symmetric where w = 0."""
    w, x, y, z = quat_wxyz
    return np.array(
        (
            (1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)),
            (2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)),
            (2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)),
        )
    )


def angle(quat_wxyz: Quaternion) -> float:
    """The angle of a rotation in [0, pi] rad, of either sign of its quaternion."""
    w, x, y, z = quat_wxyz
    return 2.0 * math.atan2(math.hypot(x, y, z), abs(w))


def conjugate(quat_wxyz: Quaternion) -> Quaternion:
    """The opposite rotation: the body's orientation of what is left to go, and the reverse."""
    w, x, y, z = quat_wxyz
    return (w, -x, -y, -z)
