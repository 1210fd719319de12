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


def sign_of_zero(q, q_d):
    e = left(q, q_d)
    return 2.0 * np.sign(e[0]) * e[1:]


def sign_of_zero_in_body_xyzw(q, q_d):
    e = right(np.roll(q, 1), np.roll(q_d, 1))
    return -2.0 * np.sign(e[0]) * e[1:]


def no_sign(q, q_d):
    return 2.0 * right(q, q_d)[1:]


def no_sign_xyzw(q, q_d):
    return -2.0 * left(np.roll(q, 1), np.roll(q_d, 1))[1:]


def no_sign_of_matrices(R, R_d):
    """Each quaternion with w >= 0, their product not."""
    q, q_d = (np.roll(Rotation.from_matrix(X).as_quat(canonical=True), 1) for X in (R, R_d))
    return 2.0 * left(q, q_d)[1:]


def half_stiff(q, q_d):
    return -0.5 * chord(right(q, q_d))


def half_stiff_of_matrices(R, R_d):
    q = Rotation.from_matrix(R_d @ R.T).as_quat(canonical=True, scalar_first=True)
    return 0.5 * chord(q)


def order_swapped(q, q_d):
    """Conjugated as xyzw, multiplied as wxyz."""
    return 2.0 * times(q_d, np.array((-1.0, -1.0, -1.0, 1.0)) * q)[1:]


def order_swapped_of_the_goal(q, q_d):
    """The same with the arguments the other way round."""
    return order_swapped(q_d, q)


def order_swapped_of_one(q, q_d):
    """xyzw: the goal as it is, the pose read as wxyz."""
    return chord(left(q, np.roll(q_d, 1)))


def order_shifted_the_wrong_way(q, q_d):
    """xyzw, made wxyz by moving the first number to the end."""
    return chord(left(np.roll(q, -1), np.roll(q_d, -1)))


def transposed(R, R_d):
    return log(R_d @ R)


def transposed_columns(R, R_d):
    """Columns against rows."""
    return 0.5 * sum(np.cross(R[:, i], R_d[i, :]) for i in range(3))


def body_for_base(R, R_d):
    """R^T applied where R would be right."""
    return R.T @ log(R.T @ R_d)


def base_rotated_again(R, R_d):
    return -R @ log(R_d @ R.T)


def axis_clip(R, R_d):
    return np.clip(log(R_d @ R.T), -0.5, 0.5)


def axis_clip_tight(q, q_d):
    return np.clip(-chord(right(q, q_d)), -0.1, 0.1)


def norm_clip(R, R_d):
    e = log(R.T @ R_d)
    return e * min(1.0, 1.0 / max(np.linalg.norm(e), 1e-12))


def norm_clip_by_the_largest(q, q_d):
    e = chord(left(q, q_d))
    return e / max(1.0, np.abs(e).max() / 0.3)


def clip_of_a_tick(q, q_d):
    e = chord(left(q, q_d))
    return e * min(1.0, 0.008 / max(np.linalg.norm(e), 1e-12))


def arc_cosine(R, R_d):
    X = R_d @ R.T
    theta = np.arccos(np.clip(0.5 * (np.trace(X) - 1.0), -1.0, 1.0))
    if theta == 0.0:
        return np.zeros(3)
    return theta / (2.0 * np.sin(theta)) * np.array((X[2, 1] - X[1, 2], X[0, 2] - X[2, 0], X[1, 0] - X[0, 1]))


def arc_cosine_of_quaternion(q, q_d):
    e = right(q, q_d)
    e = e if e[0] >= 0.0 else -e
    length = np.linalg.norm(e[1:])
    return -2.0 * np.arccos(min(e[0], 1.0)) * e[1:] / length if length else np.zeros(3)


def euler_difference(R, R_d):
    difference = Rotation.from_matrix(R_d).as_euler("ZYX") - Rotation.from_matrix(R).as_euler("ZYX")
    return (difference + np.pi) % (2.0 * np.pi) - np.pi


def euler_difference_of_quaternions(q, q_d):
    """xyzw."""
    return euler_difference(*(Rotation.from_quat(one).as_matrix() for one in (q, q_d)))


def euler_of_difference(R, R_d):
    return -Rotation.from_matrix(R_d @ R.T).as_euler("xyz")


def wrong_wrap(R, R_d):
    """Angles' differences as they are."""
    return Rotation.from_matrix(R_d).as_euler("xyz") - Rotation.from_matrix(R).as_euler("xyz")


def wrong_wrap_of_angle(R, R_d):
    """An angle from 0 to 360° about an axis of the upper half space."""
    e = log(R.T @ R_d)
    theta = np.linalg.norm(e)
    return e if theta == 0.0 or e[2] >= 0.0 else (theta - 2.0 * np.pi) * e / theta


def single_precision(R, R_d):
    X = R_d.astype(np.float32) @ R.T.astype(np.float32)
    return log(X.astype(float))


def single_precision_quaternion(q, q_d):
    return chord(left(np.roll(q, 1).astype(np.float32), np.roll(q_d, 1).astype(np.float32)).astype(np.float32))


def deadband(R, R_d):
    e = log(R.T @ R_d)
    return e if np.linalg.norm(e) > 5e-3 else np.zeros(3)


def deadband_of_components(q, q_d):
    e = -chord(left(q, q_d))
    return np.where(np.abs(e) < 5e-3, 0.0, e)


def jump_at_90(R, R_d):
    """The sine up to 90°, half the angle beyond."""
    e = columns(R, R_d)
    return e if np.trace(R_d @ R.T) >= 1.0 else 0.5 * log(R_d @ R.T)


def jump_at_90_of_quaternions(q, q_d):
    e = right(q, q_d)
    return chord(e) * (1.0 if e[0] ** 2 > 0.5 else 1.2)


def nan_at_identity(R, R_d):
    e = log(R_d @ R.T)
    theta = np.linalg.norm(e)
    return theta * (e / theta)


def nan_at_identity_xyzw(q, q_d):
    e = right(np.roll(q, 1), np.roll(q_d, 1))
    return chord(e) / np.linalg.norm(e[1:]) * np.linalg.norm(e[1:])


def transposes_in_place(R, R_d):
    R[:] = R.T.copy()
    return log(R_d @ R)


PLANTED: dict = {
    sign_of_zero: {"dead-at-180"},
    sign_of_zero_in_body_xyzw: {"dead-at-180"},
    no_sign: {"double-cover"},
    no_sign_xyzw: {"double-cover"},
    no_sign_of_matrices: {"long-way"},
    half_stiff: {"stiffness"},
    half_stiff_of_matrices: {"stiffness"},
    order_swapped: {"quaternion-order"},
    order_swapped_of_the_goal: {"quaternion-order"},
    order_swapped_of_one: {"quaternion-order"},
    order_shifted_the_wrong_way: {"quaternion-order"},
    transposed: {"transpose"},
    transposed_columns: {"transpose"},
    body_for_base: {"frame"},
    base_rotated_again: {"frame"},
    axis_clip: {"axis-clip"},
    axis_clip_tight: {"axis-clip"},
    norm_clip: {"norm-clip"},
    norm_clip_by_the_largest: {"norm-clip"},
    clip_of_a_tick: {"norm-clip"},
    arc_cosine: {"dead-at-180", "digits-near-180", "digits-near-0", "non-unit"},
    arc_cosine_of_quaternion: {"digits-near-0", "non-unit"},
    euler_difference: {"euler-angles"},
    euler_difference_of_quaternions: {"euler-angles"},
    euler_of_difference: {"euler-angles"},
    wrong_wrap: {"euler-angles", "long-way"},
    wrong_wrap_of_angle: {"long-way"},
    single_precision: {"single-precision"},
    single_precision_quaternion: {"single-precision"},
    deadband: {"deadband"},
    deadband_of_components: {"deadband"},
    jump_at_90: {"jump"},
    jump_at_90_of_quaternions: {"jump"},
    nan_at_identity: {"not-a-number"},
    nan_at_identity_xyzw: {"not-a-number"},
    transposes_in_place: {"changes-inputs"},
}
"""Function -> what it must be found to have, notes too; nothing else is true of it."""
