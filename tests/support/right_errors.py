"""Orientation errors against which nothing is to be said, in conventions of all kinds."""

import math

import mujoco
import numpy as np
import pinocchio
from scipy.spatial import transform

from bench.law import Gains, Goal, Rotation
from bench.law.contenders.registry import regulator
from support.planted import CONJUGATE, chord, columns, left, log, right

AT_REST = (0.0, 0.0, 0.0)
UNIT = Gains(1.0, 1.0)


def scipy_in_base(R, R_d):
    return log(R_d @ R.T)


def scipy_in_body_from_goal(R, R_d):
    return log(R_d.T @ R)


def scipy_of_wxyz(q, q_d):
    q, q_d = (transform.Rotation.from_quat(one, scalar_first=True) for one in (q, q_d))
    return (q_d * q.inv()).as_rotvec()


def scipy_of_xyzw(q, q_d):
    q, q_d = transform.Rotation.from_quat(q), transform.Rotation.from_quat(q_d)
    return -(q.inv() * q_d).as_rotvec()


def numpy_columns_list_in_body(R, R_d):
    X = R.T @ R_d
    return [[0.5 * (X[j, i] - X[i, j])] for i, j in ((1, 2), (2, 0), (0, 1))]


def numpy_chord(q, q_d):
    return chord(left(q, q_d))


def numpy_atan2(q, q_d):
    e = left(q, q_d)
    e = -e if e[0] < 0.0 else e
    length = math.sqrt(e[1:] @ e[1:])
    return 2.0 * math.atan2(length, e[0]) / length * e[1:] if length else np.zeros(3)


def numpy_mrp(q, q_d):
    e = right(q, q_d)
    return 4.0 * e[1:] / (1.0 + e[0]) if e[0] >= 0.0 else -4.0 * e[1:] / (1.0 - e[0])


def numpy_form_of_no_name(R, R_d):
    """(1 + cos(theta/2)) sin(theta/2) k, a form of no name."""
    e = chord(np.roll(transform.Rotation.from_matrix(R_d @ R.T).as_quat(canonical=True), 1))
    return 0.5 * e * (1.0 + math.sqrt(max(0.0, 1.0 - 0.25 * (e @ e))))


def mujoco_sub_quat(q, q_d):
    e = np.empty(3)
    mujoco.mju_subQuat(e, q_d, q)
    return e


def mujoco_quat_to_vel(q, q_d):
    e, product = np.empty(3), np.empty(4)
    mujoco.mju_mulQuat(product, q_d, CONJUGATE * q)
    mujoco.mju_quat2Vel(e, product, 1.0)
    return e


def mujoco_of_matrices(R, R_d):
    q, e = np.empty(4), np.empty(3)
    mujoco.mju_mat2Quat(q, (R_d @ R.T).ravel())
    mujoco.mju_quat2Vel(e, q, 1.0)
    return e


def pinocchio_of_xyzw(q, q_d):
    q, q_d = (pinocchio.Quaternion(w, x, y, z) for x, y, z, w in (q, q_d))
    return pinocchio.log3((q.inverse() * q_d).matrix())


def ours(name):
    """A regulator of the benchmark at rest and with unit gains."""
    law, memory = regulator(name).law, (regulator(name).memory,)
    memory = memory if any(memory) else ()

    def error(R, R_d):
        answer = law(of_columns(R), AT_REST, Goal(of_columns(R_d)), UNIT, *memory)
        return answer[0] if memory else answer

    return error


def of_columns(R):
    return Rotation(*map(tuple, R.T.tolist()))


BASE, BODY = ("base", "to-goal"), ("body", "to-goal")
BASE_BACK, BODY_BACK = ("base", "from-goal"), ("body", "from-goal")

RIGHT = {
    "scipy-in-base": (scipy_in_base, ("matrix", *BASE, "rotation-vector")),
    "scipy-in-body-from-goal": (scipy_in_body_from_goal, ("matrix", *BODY_BACK, "rotation-vector")),
    "scipy-of-wxyz": (scipy_of_wxyz, ("wxyz", *BASE, "rotation-vector")),
    "scipy-of-xyzw": (scipy_of_xyzw, ("xyzw", *BODY_BACK, "rotation-vector")),
    "scipy-mrp": (lambda R, R_d: 4.0 * transform.Rotation.from_matrix(R.T @ R_d).as_mrp(), ("matrix", *BODY, "mrp")),
    "scipy-vector-part": (
        lambda R, R_d: 2.0 * transform.Rotation.from_matrix(R @ R_d.T).as_quat(canonical=True)[:3],
        ("matrix", *BASE_BACK, "sine-of-half"),
    ),
    "numpy-columns": (columns, ("matrix", *BASE, "sine")),
    "numpy-columns-list-in-body": (numpy_columns_list_in_body, ("matrix", *BODY, "sine")),
    "numpy-chord": (numpy_chord, ("wxyz", *BASE, "sine-of-half")),
    "numpy-chord-xyzw-from-goal": (
        lambda q, q_d: -chord(right(np.roll(q, 1), np.roll(q_d, 1))),
        ("xyzw", *BODY_BACK, "sine-of-half"),
    ),
    "numpy-atan2": (numpy_atan2, ("wxyz", *BASE, "rotation-vector")),
    "numpy-mrp": (numpy_mrp, ("wxyz", *BODY, "mrp")),
    "numpy-form-of-no-name": (numpy_form_of_no_name, ("matrix", *BASE, "")),
    "mujoco-sub-quat": (mujoco_sub_quat, ("wxyz", *BODY, "rotation-vector")),
    "mujoco-sub-quat-from-goal": (lambda q, q_d: mujoco_sub_quat(q_d, q), ("wxyz", *BODY_BACK, "rotation-vector")),
    "mujoco-quat-to-vel": (mujoco_quat_to_vel, ("wxyz", *BASE, "rotation-vector")),
    "mujoco-of-matrices": (mujoco_of_matrices, ("matrix", *BASE, "rotation-vector")),
    "pinocchio-in-base": (lambda R, R_d: pinocchio.log3(R_d @ R.T), ("matrix", *BASE, "rotation-vector")),
    "pinocchio-in-body": (lambda R, R_d: pinocchio.log3(R.T @ R_d), ("matrix", *BODY, "rotation-vector")),
    "pinocchio-of-xyzw": (pinocchio_of_xyzw, ("xyzw", *BODY, "rotation-vector")),
    "quaternion-shortest": (ours("quaternion-shortest"), ("matrix", *BASE, "sine-of-half")),
    "rotation-vector": (ours("rotation-vector"), ("matrix", *BASE, "rotation-vector")),
    "rotation-matrix": (ours("rotation-matrix"), ("matrix", *BASE, "sine")),
    "mrp": (ours("mrp"), ("matrix", *BASE, "mrp")),
    "square-root": (ours("square-root"), ("matrix", *BASE, "sine-of-half")),
    "in-engine": (ours("in-engine"), ("matrix", *BASE, "rotation-vector")),
    "late-braking": (ours("late-braking"), ("matrix", *BASE, "")),
}
"""Name -> a function, what it takes, frame, direction, form."""
