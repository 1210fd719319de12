"""Orientation errors with one fault each, planted; written with numpy and scipy, in conventions of all kinds."""

import functools

import numpy as np
from scipy.spatial.transform import Rotation

from bench.audit import audit

audited = functools.cache(audit)
"""Several tests look at one report."""

CONJUGATE = np.array((1.0, -1.0, -1.0, -1.0))


def times(p, q):
    """Hamilton product, wxyz."""
    w = p[0] * q[0] - p[1:] @ q[1:]
    return np.array((w, *(p[0] * q[1:] + q[0] * p[1:] + np.cross(p[1:], q[1:]))))


def left(q, q_d):
    """q_d q*, in base."""
    return times(q_d, CONJUGATE * q)


def right(q, q_d):
    """q* q_d, in body."""
    return times(CONJUGATE * q, q_d)


def log(X):
    return Rotation.from_matrix(X).as_rotvec()


def chord(q):
    """2 sin(theta/2) k of either sign of q; at w = 0 too."""
    return 2.0 * q[1:] if q[0] >= 0.0 else -2.0 * q[1:]


def columns(R, R_d):
    return 0.5 * sum(np.cross(R[:, i], R_d[:, i]) for i in range(3))


def of_log(change):
    """Return an error of matrices: change(theta k, theta) of the rotation vector in base."""

    def error(R, R_d):
        e = log(R_d @ R.T)
        return change(e, np.linalg.norm(e))

    return error


def of_sine(change):
    """Return an error of matrices: change(sin(theta) k, sin(theta), cos(theta), R_d R^T)."""

    def error(R, R_d):
        v, X = columns(R, R_d), R_d @ R.T
        return change(v, np.linalg.norm(v), 0.5 * (np.trace(X) - 1.0), X)

    return error


def of_arc_cosine(constant=0.0, least=0.0):
    """Return an error theta k of matrices, divided by sin(theta) plus a constant, and zero up to the least angle."""

    def change(v, s, c, X):
        theta = np.arccos(np.clip(c, -1.0, 1.0))
        return theta / (np.sin(theta) + constant) * v if theta > least else np.zeros(3)

    return of_sine(change)


def of_xyzw(error):
    """Return an error of quaternions wxyz as one of xyzw."""
    return lambda q, q_d: error(np.roll(q, 1), np.roll(q_d, 1))


def of_matrices(error):
    """Return an error of quaternions wxyz as one of matrices, each read with w >= 0."""
    return lambda *given: error(*(Rotation.from_matrix(X).as_quat(canonical=True, scalar_first=True) for X in given))


def signed(e):
    """2 sgn(w) v of a quaternion, whose sign of 0 is 0."""
    return 2.0 * np.sign(e[0]) * e[1:]


def shortened(e, most):
    return e * min(1.0, most / max(np.linalg.norm(e), 1e-12))


def normalized(e):
    """An axis times its angle, which has no axis at 0."""
    return np.linalg.norm(e) * (e / np.linalg.norm(e))


def sign_of_zero(q, q_d):
    return signed(left(q, q_d))


def half_stiff(q, q_d):
    return -0.5 * chord(right(q, q_d))


def order_swapped(q, q_d):
    """Conjugated as xyzw, multiplied as wxyz."""
    return 2.0 * times(q_d, np.array((-1.0, -1.0, -1.0, 1.0)) * q)[1:]


def axis_clip(R, R_d):
    return np.clip(log(R_d @ R.T), -0.5, 0.5)


def norm_clip(R, R_d):
    return shortened(log(R.T @ R_d), 1.0)


def euler_difference(R, R_d):
    difference = Rotation.from_matrix(R_d).as_euler("ZYX") - Rotation.from_matrix(R).as_euler("ZYX")
    return (difference + np.pi) % (2.0 * np.pi) - np.pi


def single(*numbers):
    return (one.astype(np.float32) for one in numbers)


def deadband_of_components(q, q_d):
    e = -chord(left(q, q_d))
    return np.where(np.abs(e) < 5e-3, 0.0, e)


def jump_at_90_of_quaternions(q, q_d):
    e = right(q, q_d)
    return chord(e) * (1.0 if e[0] ** 2 > 0.5 else 1.2)


def transposes_in_place(R, R_d):
    R[:] = R.T.copy()
    return log(R_d @ R)


PLANTED: dict = {
    "sign-of-zero": (sign_of_zero, {"dead-at-180"}),
    "sign-of-zero-in-body-xyzw": (of_xyzw(lambda q, q_d: -signed(right(q, q_d))), {"dead-at-180"}),
    "no-sign": (lambda q, q_d: 2.0 * right(q, q_d)[1:], {"double-cover"}),
    "no-sign-xyzw": (of_xyzw(lambda q, q_d: -2.0 * left(q, q_d)[1:]), {"double-cover"}),
    "no-sign-of-matrices": (of_matrices(lambda q, q_d: 2.0 * left(q, q_d)[1:]), {"long-way"}),
    "half-stiff": (half_stiff, {"stiffness"}),
    "half-stiff-of-matrices": (of_matrices(lambda q, q_d: 0.5 * chord(left(q, q_d))), {"stiffness"}),
    "order-swapped": (order_swapped, {"quaternion-order"}),
    "order-swapped-of-the-goal": (
        lambda q, q_d: order_swapped(q_d, q),
        {"quaternion-order"},
    ),  # the same with the arguments the other way round
    "order-swapped-of-one": (
        lambda q, q_d: chord(left(q, np.roll(q_d, 1))),
        {"quaternion-order"},
    ),  # xyzw: the goal as it is, the pose read as wxyz
    "order-shifted-the-wrong-way": (
        lambda q, q_d: chord(left(np.roll(q, -1), np.roll(q_d, -1))),
        {"quaternion-order"},
    ),  # xyzw, made wxyz by moving the first number to the end
    "transposed": (lambda R, R_d: log(R_d @ R), {"transpose"}),
    "transposed-columns": (
        lambda R, R_d: 0.5 * sum(np.cross(R[:, i], R_d[i, :]) for i in range(3)),
        {"transpose"},
    ),  # columns against rows
    "body-for-base": (lambda R, R_d: R.T @ log(R.T @ R_d), {"frame"}),  # R^T applied where R would be right
    "base-rotated-again": (lambda R, R_d: -R @ log(R_d @ R.T), {"frame"}),
    "axis-clip": (axis_clip, {"axis-clip"}),
    "axis-clip-tight": (lambda q, q_d: np.clip(-chord(right(q, q_d)), -0.1, 0.1), {"axis-clip"}),
    "norm-clip": (norm_clip, {"norm-clip"}),
    "norm-clip-by-the-largest": (of_log(lambda e, _: e / max(1.0, np.abs(e).max() / 0.3)), {"norm-clip"}),
    "clip-of-a-tick": (lambda q, q_d: shortened(chord(left(q, q_d)), 0.008), {"norm-clip"}),
    "arc-cosine": (
        of_arc_cosine(),
        {"dead-at-180", "digits-near-180", "digits-near-0", "non-unit"},
    ),
    "euler-difference": (euler_difference, {"euler-angles"}),
    "euler-difference-of-quaternions": (
        lambda q, q_d: euler_difference(*(Rotation.from_quat(one).as_matrix() for one in (q, q_d))),
        {"euler-angles"},
    ),  # xyzw
    "euler-of-difference": (lambda R, R_d: -Rotation.from_matrix(R_d @ R.T).as_euler("xyz"), {"euler-angles"}),
    "wrong-wrap": (
        lambda R, R_d: Rotation.from_matrix(R_d).as_euler("xyz") - Rotation.from_matrix(R).as_euler("xyz"),
        {"euler-angles", "long-way"},
    ),  # angles' differences as they are
    "wrong-wrap-of-angle": (
        of_log(lambda e, theta: (theta - 2.0 * np.pi) / theta * e if e[2] < 0.0 else e),
        {"long-way"},
    ),  # from 0 to 360° about an axis of the upper half space
    "single-precision": (lambda R, R_d: log(np.matmul(*single(R_d, R.T)).astype(float)), {"single-precision"}),
    "single-precision-quaternion": (
        of_xyzw(lambda q, q_d: chord(*single(left(*single(q, q_d))))),
        {"single-precision"},
    ),
    "deadband": (of_log(lambda e, theta: e if theta > 5e-3 else np.zeros(3)), {"deadband"}),
    "deadband-of-components": (deadband_of_components, {"deadband"}),
    "jump-at-90": (lambda R, R_d: columns(R, R_d) if np.trace(R_d @ R.T) >= 1.0 else 0.5 * log(R_d @ R.T), {"jump"}),
    "jump-at-90-of-quaternions": (jump_at_90_of_quaternions, {"jump"}),
    "nan-at-identity": (lambda R, R_d: normalized(log(R_d @ R.T)), {"not-a-number"}),
    "nan-at-identity-xyzw": (of_xyzw(lambda q, q_d: normalized(chord(right(q, q_d)))), {"not-a-number"}),
    "transposes-in-place": (transposes_in_place, {"changes-inputs"}),
}
"""Name -> a function, what it must be found to have, notes too; nothing else is true of it."""
