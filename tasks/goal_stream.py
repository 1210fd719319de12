"""Goals that arrive one after the other and are filled in between: what reaches a controller from a policy or planner.

The true goal turns through 180 degrees off the base frame, where the coordinates of goals jump:

    R_d(t) = exp(a [k]x) exp(b [m]x),   a = A_0 + RATE t,   b = SWAY sin(2 t)

It is sent every PERIOD_S in coordinates, and a filter makes a goal of every tick:

    held            the last goal that came
    componentwise   c = (1 - s) c_0 + s c_1, of a quaternion scaled to length 1
    slerp           sin((1 - s) w)/sin(w) q_0 + sin(s w)/sin(w) q_1, cos w = q_0 . q_1 (Shoemake 1985)
    log             R_0 exp(s log(R_0^T R_1))

Nothing is extrapolated: every filter is a period late, held goals as well.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from tasks.rotations import about, multiply

PERIOD_S, LENGTH_S = 0.05, 2.0
"""20 goals a second, as policies and planners send them."""

K, M = (1.0, 2.0, 3.0), (3.0, 0.0, -1.0)
A_0, RATE, SWAY = math.radians(120.0), 1.0, 0.3


def true_goal(time: float) -> tuple[float, float, float, float]:
    """Return the goal's unit quaternion (w, x, y, z) at a time [s], of either sign."""
    a, b = A_0 + RATE * time, SWAY * math.sin(2.0 * time)
    half = multiply(about(K, 0.5 * a), about(K, 0.5 * a))
    return multiply(half, about(M, b))


def canonical(q: np.ndarray) -> np.ndarray:
    """Quaternions (n x 4) with w >= 0, as libraries write them: the sign flips at 180 degrees."""
    return np.where(q[:, :1] < 0.0, -q, q)


def continued(q: np.ndarray) -> np.ndarray:
    """Quaternions (n x 4), each of the sign that is nearer to the one before."""
    flips = np.concatenate(([1.0], np.where(np.sum(q[1:] * q[:-1], axis=1) < 0.0, -1.0, 1.0)))
    return q * np.cumprod(flips)[:, None]


def rotation_vector(q: np.ndarray) -> np.ndarray:
    """Compute 2 atan2(|v|, w) v/|v| of quaternions (n x 4) [rad]: up to 180° if w >= 0, up to a whole turn if not."""
    length = np.linalg.norm(q[:, 1:], axis=1, keepdims=True)
    angle = 2.0 * np.arctan2(length, q[:, :1])
    return q[:, 1:] * np.where(length > 1e-12, angle / np.maximum(length, 1e-12), 2.0)


def of_rotation_vector(v: np.ndarray) -> np.ndarray:
    """Return unit quaternions (n x 4) of rotation vectors (n x 3)."""
    half = 0.5 * np.linalg.norm(v, axis=1, keepdims=True)
    return np.hstack((np.cos(half), 0.5 * np.sinc(half / math.pi) * v))


def componentwise(c: np.ndarray, s: np.ndarray) -> np.ndarray:
    """(1 - s) c_0 + s c_1 between each two of the rows, for every share s in [0, 1)."""
    return np.concatenate([(1.0 - s) * c_0 + s * c_1 for c_0, c_1 in itertools.pairwise(c)])


def normalized(q: np.ndarray) -> np.ndarray:
    """Return the rows scaled to length 1."""
    return q / np.linalg.norm(q, axis=1, keepdims=True)


def slerp(q: np.ndarray, s: np.ndarray) -> np.ndarray:
    """Interpolate along the great circle between each two quaternions; their signs choose the shorter or longer arc."""
    made = []
    for q_0, q_1 in itertools.pairwise(q):
        w = 2.0 * math.atan2(float(np.linalg.norm(q_1 - q_0)), float(np.linalg.norm(q_1 + q_0)))
        made.append((np.sin((1.0 - s) * w) * q_0 + np.sin(s * w) * q_1) / math.sin(w))
    return np.concatenate(made)


def by_log(q: np.ndarray, s: np.ndarray) -> np.ndarray:
    """R_0 exp(s log(R_0^T R_1)), in quaternions: what is left to turn, by the shorter way, in proportion."""
    made = []
    for q_0, q_1 in itertools.pairwise(q):
        w, x, y, z = q_0.tolist()
        left = rotation_vector(canonical(np.array([multiply((w, -x, -y, -z), tuple(q_1.tolist()))])))
        made.append(np.array([multiply((w, x, y, z), tuple(p)) for p in of_rotation_vector(s * left).tolist()]))
    return np.concatenate(made)


def by_quaternion(q: np.ndarray, s: np.ndarray) -> np.ndarray:
    """Interpolate the components of quaternions, and scale to length 1."""
    return normalized(componentwise(q, s))


def by_vector(q: np.ndarray, s: np.ndarray) -> np.ndarray:
    """Interpolate the components of rotation vectors."""
    return of_rotation_vector(componentwise(rotation_vector(q), s))


class Stream(NamedTuple):
    """How goals are sent and filled in.

    signed(q) -> the quaternions that are sent (n x 4), of the signs with which they arrive. filled(q, s) -> goals: of
    these and the shares s (m x 1), those of (n - 1) m ticks.
    """

    name: str
    arrives: str
    between: str
    signed: Callable[[np.ndarray], np.ndarray]
    filled: Callable[[np.ndarray, np.ndarray], np.ndarray]


def held(q: np.ndarray, s: np.ndarray) -> np.ndarray:
    """Return the last goal that came."""
    return np.repeat(q[:-1], len(s), axis=0)


STREAMS = (
    Stream("held", "matrix", "held", canonical, held),
    Stream("log", "matrix", "log", canonical, by_log),
    Stream("rotation-vector", "rotation vector, up to 180°", "componentwise", canonical, by_vector),
    Stream("rotation-vector-continued", "rotation vector, continued", "componentwise", continued, by_vector),
    Stream("quaternion", "quaternion, w ≥ 0", "componentwise", canonical, by_quaternion),
    Stream("quaternion-continued", "quaternion, nearer sign", "componentwise", continued, by_quaternion),
    Stream("slerp", "quaternion, w ≥ 0", "slerp", canonical, slerp),
    Stream("slerp-continued", "quaternion, nearer sign", "slerp", continued, slerp),
)
"""From what cannot go wrong to what is written in earnest and does."""


def sent() -> np.ndarray:
    """Return the goals that are sent (n x 4)."""
    return np.array([true_goal(k * PERIOD_S) for k in range(round(LENGTH_S / PERIOD_S) + 1)])


def goals(stream: Stream, dt: float) -> np.ndarray:
    """Return the goal of every tick (n x 4), of the sign that the stream gives it; dt [s] divides PERIOD_S."""
    count = round(PERIOD_S / dt)
    return stream.filled(stream.signed(sent()), np.arange(count)[:, None] / count)
