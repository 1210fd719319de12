"""Libraries of rotations in Python: what each of them returns for the error, function by function.

An idiom is what users write on functions of a library. Every package is imported by the function that needs it.
"""

from typing import Any

import numpy as np

from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library, vector_part


def scipy() -> list[Library]:
    """Return the conversions of scipy.spatial.transform.Rotation."""
    from scipy.spatial.transform import Rotation

    from_matrix = Rotation.from_matrix
    functions = (
        Function("as_rotvec, of a matrix", MATRIX, lambda R: from_matrix(R).as_rotvec()),
        Function(
            "as_rotvec, of a quaternion", QUATERNION, lambda q: Rotation.from_quat(q, scalar_first=True).as_rotvec()
        ),
        vector_part("as_quat", lambda R: 2.0 * from_matrix(R).as_quat()[:3], "`as_quat(canonical=True)`"),
        Function("4 as_mrp", MATRIX, lambda R: 4.0 * from_matrix(R).as_mrp(), "mrp"),
        Function('as_euler("ZYX")', MATRIX, lambda R: from_matrix(R).as_euler("ZYX")[::-1], "z-y-x"),
    )
    return [Library("scipy", "scipy", functions)]


def numpy_quaternion() -> list[Library]:
    """Return the rotation vectors of numpy-quaternion."""
    import quaternion

    to_vector, thread = quaternion.as_rotation_vector, "moble/quaternion#58"
    functions = (
        Function("as_rotation_vector", QUATERNION, lambda q: to_vector(quaternion.quaternion(*q)), thread=thread),
        Function(
            "from_rotation_matrix, as_rotation_vector",
            MATRIX,
            lambda R: to_vector(quaternion.from_rotation_matrix(R)),
            fix="`-q` where `q.w < 0`, between the two",
            thread=thread,
        ),
    )
    return [Library("numpy-quaternion", "numpy-quaternion", functions)]


def pyquaternion() -> list[Library]:
    """Return angle times axis of pyquaternion, and its logarithm."""
    from pyquaternion import Quaternion

    def vector(found: Quaternion) -> np.ndarray:
        return found.angle * found.axis

    functions = (
        Function("angle, axis", QUATERNION, lambda q: vector(Quaternion(*q))),
        Function("angle, axis, of a matrix", MATRIX, lambda R: vector(Quaternion(matrix=R))),
        vector_part("log", lambda q: 2.0 * Quaternion.log(Quaternion(*q)).vector, "`angle * axis`", is_logarithm=True),
    )
    return [Library("pyquaternion", "pyquaternion", functions)]


def pytransform3d() -> list[Library]:
    """Return the conversions of pytransform3d.rotations."""
    from pytransform3d import rotations

    def of_matrix(R: np.ndarray) -> np.ndarray:
        found = rotations.axis_angle_from_matrix(R)
        return found[3] * found[:3]

    functions = (
        Function("axis_angle_from_matrix", MATRIX, of_matrix, thread="dfki-ric/pytransform3d#43"),
        Function("compact_axis_angle_from_quaternion", QUATERNION, rotations.compact_axis_angle_from_quaternion),
        Function("4 mrp_from_quaternion", QUATERNION, lambda q: 4.0 * rotations.mrp_from_quaternion(q), "mrp"),
    )
    return [Library("pytransform3d", "pytransform3d", functions)]


def transforms3d() -> list[Library]:
    """Return axis and angle of transforms3d, and its Euler angles."""
    from transforms3d import axangles, euler, quaternions

    def vector(axis: Any, angle: float) -> np.ndarray:
        return angle * np.asarray(axis)

    functions = (
        Function("mat2axangle", MATRIX, lambda R: vector(*axangles.mat2axangle(R))),
        Function("quat2axangle", QUATERNION, lambda q: vector(*quaternions.quat2axangle(q))),
        Function(
            "mat2quat, quat2axangle", MATRIX, lambda R: vector(*quaternions.quat2axangle(quaternions.mat2quat(R)))
        ),
        Function("mat2euler", MATRIX, lambda R: np.array(euler.mat2euler(R, "sxyz")), "z-y-x"),
    )
    return [Library("transforms3d", "transforms3d", functions)]


def jaxlie() -> list[Library]:
    """Return the logarithms of jaxlie's SO3 and its angles, compiled, in double precision."""
    import jax
    from jaxlie import SO3

    jax.config.update("jax_enable_x64", True)
    log_of_matrix, log = jax.jit(lambda R: SO3.from_matrix(R).log()), jax.jit(lambda q: SO3(q).log())
    rpy = jax.jit(lambda R: SO3.from_matrix(R).as_rpy_radians())
    functions = (
        Function("SO3.from_matrix, log", MATRIX, log_of_matrix),
        Function("SO3.log", QUATERNION, log),
        Function("SO3.as_rpy_radians", MATRIX, lambda R: np.array(rpy(R)), "z-y-x"),
    )
    return [Library("jaxlie", "jaxlie", functions)]


def spatialmath() -> list[Library]:
    """Return the logarithm of Spatial Math Toolbox, its angle times axis, its small-angle difference and its angles."""
    from spatialmath import SO3, UnitQuaternion, base

    def vector(theta: float, axis: np.ndarray) -> np.ndarray:
        return theta * axis

    functions = (
        Function("base.trlog", MATRIX, lambda R: base.trlog(R, twist=True)),
        Function("SO3.angvec", MATRIX, lambda R: vector(*SO3(R).angvec())),
        Function("UnitQuaternion.angvec", QUATERNION, lambda q: vector(*UnitQuaternion(q).angvec())),
        Function("base.tr2delta", MATRIX, lambda R: base.tr2delta(np.eye(4), base.r2t(R))[3:], "sine"),
        Function('base.tr2rpy(order="zyx")', MATRIX, lambda R: base.tr2rpy(R, order="zyx"), "z-y-x"),
    )
    return [Library("spatialmath", "spatialmath-python", functions)]


def gtsam() -> list[Library]:
    """Return the logarithm of GTSAM's Rot3, its angle times axis and its angles."""
    from gtsam import Rot3

    def vector(axis: Any, angle: float) -> np.ndarray:
        return angle * np.ravel(axis.point3())

    functions = (
        Function("Rot3.Logmap", MATRIX, lambda R: Rot3.Logmap(Rot3(R))),
        Function("Rot3.axisAngle", MATRIX, lambda R: vector(*Rot3(R).axisAngle())),
        Function("Rot3.Logmap, of a quaternion", QUATERNION, lambda q: Rot3.Logmap(Rot3.Quaternion(*q))),
        Function("Rot3.rpy", MATRIX, lambda R: Rot3(R).rpy(), "z-y-x"),
    )
    return [Library("gtsam", "gtsam", functions)]


def pinocchio() -> list[Library]:
    """Return the logarithms of Pinocchio, Eigen's angle times axis, and its angles."""
    import pinocchio

    def vector(found: Any) -> np.ndarray:
        return found.angle * found.axis

    functions = (
        Function("log3, of a matrix", MATRIX, lambda R: pinocchio.log3(R)),
        Function("log3, of a quaternion", QUATERNION, lambda q: pinocchio.log3(pinocchio.Quaternion(*q))),
        Function("log6, angular part", MATRIX, lambda R: pinocchio.log6(pinocchio.SE3(R, np.zeros(3))).angular),
        Function("AngleAxis (Eigen)", MATRIX, lambda R: vector(pinocchio.AngleAxis(R))),
        Function("rpy.matrixToRpy", MATRIX, lambda R: pinocchio.rpy.matrixToRpy(R), "z-y-x"),
    )
    return [Library("pinocchio", "pin", functions)]


def dm_control() -> list[Library]:
    """Return the conversions of dm_control.utils.transformations."""
    from absl import logging
    from dm_control.utils import transformations as its

    logging.set_verbosity(logging.ERROR)  # rmat_to_euler warns of every pole that it gets
    functions = (
        Function("quat_to_axisangle", QUATERNION, its.quat_to_axisangle),
        vector_part("quat_log", lambda q: 2.0 * its.quat_log(q)[1:], "`quat_to_axisangle`", is_logarithm=True),
        Function("mat_to_quat, quat_to_axisangle", MATRIX, lambda R: its.quat_to_axisangle(its.mat_to_quat(R))),
        Function(
            'rmat_to_euler("ZYX")',
            MATRIX,
            lambda R: its.rmat_to_euler(R, "ZYX")[::-1],
            "z-y-x",
            thread="google-deepmind/dm_control#555",
        ),
    )
    return [Library("dm_control", "dm-control", functions)]
