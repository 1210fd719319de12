"""Orientation errors as users write them: what is found in each, and words of the report that matter."""

import math
import zlib

import numpy as np
from scipy.linalg import logm
from scipy.spatial.transform import Rotation

from support.planted import (
    CONJUGATE,
    chord,
    columns,
    deadband_of_components,
    left,
    log,
    of_arc_cosine,
    of_log,
    of_sine,
    right,
    shortened,
    times,
)


def diagonal_axis(X):
    """pi k of a rotation by 180°, without the signs of k."""
    return np.pi * np.sqrt(np.clip(0.5 * (np.diag(X) + 1.0), 0.0, 1.0))


def cayley(R, R_d):
    X = R_d @ R.T
    S = (X - np.eye(3)) @ np.linalg.inv(X + np.eye(3))
    return 2.0 * np.array((S[2, 1], S[0, 2], S[1, 0]))


def matrix_logarithm(R, R_d):
    S = np.real(logm(R_d @ R.T))
    return np.array((S[2, 1], S[0, 2], S[1, 0]))


def swing_and_twist(q, q_d):
    """The sum of the two rotation vectors, twist about z."""
    e = Rotation.from_quat(left(q, q_d), scalar_first=True)
    w, _, _, z = e.as_quat(scalar_first=True)
    twist = Rotation.from_quat((w, 0.0, 0.0, z) if w or z else (1.0, 0.0, 0.0, 0.0), scalar_first=True)
    return (e * twist.inv()).as_rotvec() + twist.as_rotvec()


def sine_and_branch(v, s, c, X):
    """The rotation vector by atan2, with an axis from a column where the sine is small."""
    if s >= 1e-7:
        return math.atan2(s, c) * v / s
    k = (X + np.eye(3))[:, np.argmax(np.diag(X))]
    return v if c > 0.0 else np.pi * k / np.linalg.norm(k)


def cached(key):
    """Return an error that keeps what it computed for a key of R and R_d."""
    kept = {}
    return lambda R, R_d: kept.setdefault(key(R, R_d), log(R_d @ R.T))


def filtered(kept):
    """A first-order filter of the error."""
    return of_log(lambda e, _: np.add(0.9 * kept, 0.1 * e, out=kept))


def hysteresis():
    side = [1.0]

    def error(q, q_d):
        e = left(q, q_d)
        side[0] *= -1.0 if side[0] * e[0] < -0.2 else 1.0
        return 2.0 * side[0] * e[1:]

    return error


def flips_in_place(q, q_d):
    if q @ q_d < 0.0:
        q_d *= -1.0
    return 2.0 * left(q, q_d)[1:]


def linear_near_goal(q, q_d):
    q_d = q_d if q @ q_d >= 0.0 else -q_d
    return 2.0 * (q_d - q)[1:] if q @ q_d > 0.9995 else chord(left(q, q_d))


def shadow(q, q_d):
    e = left(q, q_d)
    s = e[1:] / (1.0 + e[0])
    return 4.0 * s if s @ s <= 1.0 else -4.0 * s / (s @ s)


def whole_turn(e):
    """An angle from 0 to 360°, of a quaternion of any sign."""
    length = np.linalg.norm(e[1:])
    return 2.0 * np.arctan2(length, e[0]) * e[1:] / length if length else np.zeros(3)


def lee_over_root(R, R_d):
    X = R_d.T @ R
    return columns(R_d.T, R.T) / np.sqrt(1.0 + np.trace(X))


def raises_at_times(R, R_d):
    if zlib.crc32(R.tobytes()) % 500 == 0:
        raise ValueError("lost")
    return log(R_d @ R.T)


def arc_cosine_of_dot(q, q_d):
    e = chord(right(q, q_d))
    return np.arccos(np.clip(2.0 * (q @ q_d) ** 2 - 1.0, -1.0, 1.0)) * e / np.linalg.norm(e) if e.any() else e


def arc_tangent(q, q_d):
    e = left(q, q_d)
    s = np.linalg.norm(e[1:])
    return 2.0 * np.arctan(s / e[0]) * e[1:] / s if s else e[1:]


MIRROR = np.diag((1.0, 1.0, -1.0))
RNG = np.random.default_rng(3)

USERS: dict = {
    # of a referee
    "degrees | stiffness | the stiffness is 57.3 times": of_log(lambda e, _: np.degrees(e)),
    "half-angle | stiffness | multiply by 2: the angle of a quaternion": of_log(lambda e, _: 0.5 * e),
    "degrees-in-sine | stiffness | in degrees; Cure: convert to radians (": of_log(
        lambda e, theta: np.sin(np.degrees(theta)) * e / theta if theta else e
    ),
    "gibbs | not-a-number | 2 tan(θ/2), has no end": lambda q, q_d: 2.0 * left(q, q_d)[1:] / left(q, q_d)[0],
    "cayley | not-a-number | 2 tan(θ/2), has no end": cayley,
    "matrix-logarithm | dead-at-180, digits-near-180 | axis from the longest column": matrix_logarithm,
    "swing-and-twist | misaligned | off the axis by up to 5": swing_and_twist,
    "sine-and-branch |  | no fault found": of_sine(sine_and_branch),
    "octant | uneven | |e| is 1.3 times": of_log(lambda e, _: 1.3 * e if (e > 0.0).all() else e),
    "cone | uneven | |e| is 0.7 times": of_log(lambda e, theta: 0.7 * e if e[2] > 0.9986 * theta else e),
    "half-far-from-base | uneven | |e| is 0.5 times": lambda R, R_d: (
        (0.5 if np.linalg.norm(log(R)) > 2.97 else 1.0) * log(R_d @ R.T)
    ),
    "one-sign-wrong | misaligned | M = diag([1.0, -1.0, 1.0])": lambda R, R_d: columns(R, R_d) * (1.0, -1.0, 1.0),
    "z-scaled | misaligned | M = diag([1.0, 1.0, 1.2])": of_log(lambda e, _: e * (1.0, 1.0, 1.2)),
    "half-precision | single-precision | half precision": lambda R, R_d: log((R_d @ R.T).astype(np.float16)),
    "base-and-body | frame | body frame for": lambda R, R_d: (
        log(R_d @ R.T) if np.trace(R_d @ R.T) > 2.0 else log(R.T @ R_d)
    ),
    "whole-degrees | deadband | a multiple of 0.01745": of_log(lambda e, _: np.radians(np.degrees(e) // 1)),
    "raises-at-times | raises | ValueError: lost": raises_at_times,
    "backwards-past-150 | long-way | points against the axis": of_log(lambda e, theta: e if theta < 2.6 else -e),
    "power-law | stiffness | no gain is set by it": of_log(lambda e, theta: e * theta**-0.5 if theta else e),
    "stiffer-with-the-angle | stiffness | no gain is set by it": of_log(lambda e, theta: e * np.sqrt(theta)),
    "unit-vector | stiffness | no gain is set by it": of_log(lambda e, theta: e / theta if theta else e),
    # others, right
    "saturated |  | no fault found": of_log(lambda e, theta: np.tanh(theta) / theta * e if theta else e),
    "inverse |  | no fault found": lambda R, R_d: log(R_d @ np.linalg.inv(R)),
    "components-wrapped |  | no fault found": of_log(lambda e, _: (e + np.pi) % (2.0 * np.pi) - np.pi),
    "rounded-at-the-end |  | no fault found": of_log(lambda e, _: e.astype(np.float32)),
    "fortran |  | points from R_d": lambda R, R_d: log(R_d.ravel("F").reshape(3, 3) @ R),
    "cached-by-pair |  | no fault found": cached(lambda R, R_d: (R.tobytes(), R_d.tobytes())),
    "arc-tangent-of-quaternion |  | no fault found": arc_tangent,
    # others, wrong
    "vector-of-the-other-order | quaternion-order | taken as of xyzw": lambda q, q_d: 2.0 * left(q, q_d)[:3],
    "arc-cosine-kept-from-1 | dead-at-180 | e = 0 for 240": of_sine(
        lambda v, s, c, X: v / np.sinc(np.arccos(np.clip(c, -1 + 1e-6, 1 - 1e-6)) / np.pi)
    ),
    "arc-sine | dead-at-180, non-unit | atan2 instead of an arc sine": of_sine(
        lambda v, s, c, X: np.arcsin(min(s, 1.0)) * v / s if s else v
    ),
    "arc-tangent | long-way | atan2 instead of an arc tangent": of_sine(
        lambda v, s, c, X: np.arctan(s / c) * v / s if s else v
    ),
    "arc-cosine-of-dot | digits-near-0, non-unit | an arc cosine loses digits": arc_cosine_of_dot,
    "constant-in-a-denominator | digits-near-0 | do not add a constant": of_log(
        lambda e, theta: e * theta / (theta + 1e-6)
    ),
    "rotation-vectors-subtracted | misaligned | each θ k": lambda R, R_d: log(R_d) - log(R),
    "vector-parts-subtracted | misaligned | each 2 sin(θ/2) k": lambda q, q_d: 2.0 * (q_d - q)[1:],
    "tangent | not-a-number | 2 tan(θ/2), has no end": of_log(
        lambda e, theta: e * np.sinc(0.5 * theta / np.pi) / np.cos(0.5 * theta)
    ),
    "axis-of-diagonal-at-180 | axis-at-180 | with another axis\n": of_sine(
        lambda v, s, c, X: diagonal_axis(X) if np.abs(X - X.T).max() < 1e-14 and c < 0.0 else log(X)
    ),
    "four-numbers-far-away | raises | an array of shape (4,)": of_log(
        lambda e, theta: e if theta < 3.0 else np.zeros(4)
    ),
    "deadband-of-a-vector-part | deadband, stiffness | e = 0 up to": lambda q, q_d: (
        0.5 * deadband_of_components(q, q_d)
    ),
    "constant-and-deadband | dead-at-180, deadband | e = 0 up to 0.001": of_arc_cosine(1e-6, 1e-3),
    "whole-turn-too-much | long-way | points against the axis": lambda R, R_d: whole_turn(
        Rotation.from_matrix(R_d @ R.T).as_quat(scalar_first=True)
    ),
    "rounded | deadband | a multiple of 0.1": of_log(lambda e, _: np.round(e, 1)),  # its slope at the goal is 0
    "noisy | memory | another answer": of_log(lambda e, _: e * (1.0 + 1e-3 * RNG.random())),
    "filtered | memory | another answer": filtered(np.zeros(3)),
    "matrices-subtracted | misaligned | each sin θ k": lambda R, R_d: columns(np.eye(3), R_d - R),
    "left-handed | misaligned | M = diag([-1.0, -1.0, 1.0])": lambda R, R_d: log(MIRROR @ R_d @ R.T @ MIRROR),
    "reversed | misaligned | M = [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]": of_log(lambda e, _: e[::-1]),
    "gains-of-axes | misaligned | diag([100.0, 100.0, 50.0])": lambda R, R_d: log(R.T @ R_d) * (100.0, 100.0, 50.0),
    "two-columns | misaligned | near the goal e = R M R^T θ k with M = diag([1.0, 1.0, 2.0])": lambda R, R_d: (
        np.cross(R[:, 0], R_d[:, 0]) + np.cross(R[:, 1], R_d[:, 1])
    ),
    "linear-near-goal | misaligned | at 2.86° to 3.58°": linear_near_goal,
    "axis-of-diagonal | axis-at-180 | and so are rotations by up to": of_sine(
        lambda v, s, c, X: diagonal_axis(X) if c < -0.999 else sine_and_branch(v, s, c, X)
    ),
    "x-near-180 | axis-at-180 | another axis": of_log(
        lambda e, theta: np.array((np.pi, 0.0, 0.0)) if theta > 3.13 else e
    ),
    "clipped-at-3 | norm-clip | never exceeds 3": of_log(lambda e, _: shortened(e, 3.0)),
    "lee-over-root | not-a-number, stiffness | the vector part of a quaternion": lee_over_root,
    "shadow-without-antipode | double-cover | nan": shadow,
    "no-shadow | double-cover | with -q_d": lambda q, q_d: 4.0 * left(q, q_d)[1:] / (1.0 + left(q, q_d)[0]),
    "series-of-wrong-sign | jump | at 5.72958°": of_log(
        lambda e, theta: e * (1.0 - theta**2 / 3.0) if theta < 0.1 else e
    ),
    "half-forgotten-near-goal | jump | at 1.81193°": of_sine(lambda v, s, c, X: 2.0 * v if c > 0.9995 else log(X)),
    "zero-if-close | deadband | e = 0 up to": lambda R, R_d: np.zeros(3) if np.allclose(R, R_d) else log(R_d @ R.T),
    "rounded-to-6-digits | deadband | a multiple of 1e-06": of_log(lambda e, _: np.round(e, 6)),
    "hysteresis | memory | intentionally remembers": hysteresis(),
    "flips-in-place | changes-inputs | R = R.copy()": flips_in_place,
    "share-of-half-a-turn | stiffness | e is in half turns": of_log(lambda e, _: e / np.pi),
}
"""A name, what must be found, notes too, and words of the report -> a function."""


def of_nine(R):
    return np.array([R[i] for i in range(9)]).reshape(3, 3)


CALLED: dict = {
    "f(R[None], R_d[None])": lambda R, R_d: log(np.einsum("nij,nkj->nik", R_d, R)),
    "f(R.ravel(), R_d.ravel())": lambda R, R_d: log(of_nine(R_d) @ of_nine(R).T),
    "f(Rotation.from_matrix(R), Rotation.from_matrix(R_d))": lambda r, r_d: (r_d * r.inv()).as_rotvec(),
    "f(now=R, goal=R_d)": lambda *, now, goal: log(goal @ now.T),
    "f(R, R_d)[3:]": lambda R, R_d: np.append(np.zeros(3), log(R_d @ R.T)),
    "f(R, R_d)[:3]": lambda R, R_d: np.append(log(R_d @ R.T), np.zeros(3)),
    "f(np.append(np.zeros(3), q), np.append(np.zeros(3), q_d))": lambda x, x_d: chord(left(x[3:], x_d[3:])),
}
"""Code of a call -> a function that is right and answers no other."""

REFUSED: dict = {
    "keep the sign": (lambda q, q_d: times(q_d, CONJUGATE * q), "return the vector part, times the sign of the scalar"),
    "an angle": (of_log(lambda e, theta: theta), "an angle has no axis: return angle times axis"),
    "a skew matrix": (lambda R, R_d: R_d @ R.T - R @ R_d.T, "of an error matrix return the axis"),
    "axis and angle": (of_log(lambda e, theta: (e / theta if theta else e, theta)), "return the product"),
    "four arguments": (lambda x, R, x_d, R_d: x, "as: def f(R, R_d): return mine(p, R, p, R_d)"),
}
"""What cannot be asked -> a function, and the cure."""
