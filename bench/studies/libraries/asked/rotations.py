"""Libraries of rotations in Python: what each of them returns for the error, function by function."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Tested, library, vector_part


def multiply(found: Any) -> np.ndarray:
    """Return the angle times the axis of a library's object."""
    return found.angle * found.axis


@library("scipy")
def scipy() -> Iterator[Tested]:
    """Yield the conversions of scipy.spatial.transform.Rotation."""
    from scipy.spatial.transform import Rotation

    from_matrix, from_quat = Rotation.from_matrix, Rotation.from_quat
    yield Function("as_rotvec, of a matrix", MATRIX, lambda R: from_matrix(R).as_rotvec())
    yield Function("as_rotvec, of a quaternion", QUATERNION, lambda q: from_quat(q, scalar_first=True).as_rotvec())
    yield vector_part("as_quat", lambda R: 2.0 * from_matrix(R).as_quat()[:3], "`as_quat(canonical=True)`")
    yield Function("4 as_mrp", MATRIX, lambda R: 4.0 * from_matrix(R).as_mrp(), "mrp")
    yield Function('as_euler("ZYX")', MATRIX, lambda R: from_matrix(R).as_euler("ZYX")[::-1], "z-y-x")


@library("numpy-quaternion", name="numpy-quaternion")
def numpy_quaternion() -> Iterator[Tested]:
    """Yield the rotation vectors of numpy-quaternion."""
    import quaternion

    to_vector, thread = quaternion.as_rotation_vector, "moble/quaternion#58"
    yield Function("as_rotation_vector", QUATERNION, lambda q: to_vector(quaternion.quaternion(*q)), thread=thread)
    yield Function(
        "from_rotation_matrix, as_rotation_vector",
        MATRIX,
        lambda R: to_vector(quaternion.from_rotation_matrix(R)),
        fix="`-q` where `q.w < 0`, between the two",
        thread=thread,
    )


@library("pyquaternion")
def pyquaternion() -> Iterator[Tested]:
    """Yield angle times axis of pyquaternion, and its logarithm."""
    from pyquaternion import Quaternion

    yield Function("angle, axis", QUATERNION, lambda q: multiply(Quaternion(*q)))
    yield Function("angle, axis, of a matrix", MATRIX, lambda R: multiply(Quaternion(matrix=R)))
    yield vector_part("log", lambda q: 2.0 * Quaternion.log(Quaternion(*q)).vector, "`angle * axis`", is_logarithm=True)


@library("pytransform3d")
def pytransform3d() -> Iterator[Tested]:
    """Yield the conversions of pytransform3d.rotations."""
    from pytransform3d import rotations

    def of_matrix(R: np.ndarray) -> np.ndarray:
        found = rotations.axis_angle_from_matrix(R)
        return found[3] * found[:3]

    yield Function("axis_angle_from_matrix", MATRIX, of_matrix, thread="dfki-ric/pytransform3d#43")
    yield Function("compact_axis_angle_from_quaternion", QUATERNION, rotations.compact_axis_angle_from_quaternion)
    yield Function("4 mrp_from_quaternion", QUATERNION, lambda q: 4.0 * rotations.mrp_from_quaternion(q), "mrp")


@library("transforms3d")
def transforms3d() -> Iterator[Tested]:
    """Yield axis and angle of transforms3d, and its Euler angles."""
    from transforms3d import axangles, euler, quaternions

    to_axangle, to_quaternion = quaternions.quat2axangle, quaternions.mat2quat
    yield Function("mat2axangle", MATRIX, lambda R: math.prod(axangles.mat2axangle(R)))
    yield Function("quat2axangle", QUATERNION, lambda q: math.prod(to_axangle(q)))
    yield Function("mat2quat, quat2axangle", MATRIX, lambda R: math.prod(to_axangle(to_quaternion(R))))
    yield Function("mat2euler", MATRIX, lambda R: np.array(euler.mat2euler(R, "sxyz")), "z-y-x")


@library("jaxlie")
def jaxlie() -> Iterator[Tested]:
    """Yield the logarithms of jaxlie's SO3 and its angles, compiled, in double precision."""
    import jax
    from jaxlie import SO3

    jax.config.update("jax_enable_x64", True)
    log_of_matrix, log = jax.jit(lambda R: SO3.from_matrix(R).log()), jax.jit(lambda q: SO3(q).log())
    rpy = jax.jit(lambda R: SO3.from_matrix(R).as_rpy_radians())
    yield Function("SO3.from_matrix, log", MATRIX, log_of_matrix)
    yield Function("SO3.log", QUATERNION, log)
    yield Function("SO3.as_rpy_radians", MATRIX, lambda R: np.array(rpy(R)), "z-y-x")


@library("spatialmath-python")
def spatialmath() -> Iterator[Tested]:
    """Yield the logarithm of Spatial Math Toolbox, its angle times axis, its small-angle difference and its angles."""
    from spatialmath import SO3, UnitQuaternion, base

    yield Function("base.trlog", MATRIX, lambda R: base.trlog(R, twist=True))
    yield Function("SO3.angvec", MATRIX, lambda R: math.prod(SO3(R).angvec()))
    yield Function("UnitQuaternion.angvec", QUATERNION, lambda q: math.prod(UnitQuaternion(q).angvec()))
    yield Function("base.tr2delta", MATRIX, lambda R: base.tr2delta(np.eye(4), base.r2t(R))[3:], "sine")
    yield Function('base.tr2rpy(order="zyx")', MATRIX, lambda R: base.tr2rpy(R, order="zyx"), "z-y-x")


@library("gtsam")
def gtsam() -> Iterator[Tested]:
    """Yield the logarithm of GTSAM's Rot3, its angle times axis and its angles."""
    from gtsam import Rot3

    def vector(axis: Any, angle: float) -> np.ndarray:
        return angle * np.ravel(axis.point3())

    yield Function("Rot3.Logmap", MATRIX, lambda R: Rot3.Logmap(Rot3(R)))
    yield Function("Rot3.axisAngle", MATRIX, lambda R: vector(*Rot3(R).axisAngle()))
    yield Function("Rot3.Logmap, of a quaternion", QUATERNION, lambda q: Rot3.Logmap(Rot3.Quaternion(*q)))
    yield Function("Rot3.rpy", MATRIX, lambda R: Rot3(R).rpy(), "z-y-x")


@library("pin")
def pinocchio() -> Iterator[Tested]:
    """Yield the logarithms of Pinocchio, Eigen's angle times axis, and its angles."""
    import pinocchio

    yield Function("log3, of a matrix", MATRIX, lambda R: pinocchio.log3(R))
    yield Function("log3, of a quaternion", QUATERNION, lambda q: pinocchio.log3(pinocchio.Quaternion(*q)))
    yield Function("log6, angular part", MATRIX, lambda R: pinocchio.log6(pinocchio.SE3(R, np.zeros(3))).angular)
    yield Function("AngleAxis (Eigen)", MATRIX, lambda R: multiply(pinocchio.AngleAxis(R)))
    yield Function("rpy.matrixToRpy", MATRIX, lambda R: pinocchio.rpy.matrixToRpy(R), "z-y-x")


@library("dm-control")
def dm_control() -> Iterator[Tested]:
    """Yield the conversions of dm_control.utils.transformations."""
    from absl import logging
    from dm_control.utils import transformations as its

    logging.set_verbosity(logging.ERROR)  # rmat_to_euler warns of every pole that it gets
    yield Function("quat_to_axisangle", QUATERNION, its.quat_to_axisangle)
    yield vector_part("quat_log", lambda q: 2.0 * its.quat_log(q)[1:], "`quat_to_axisangle`", is_logarithm=True)
    yield Function("mat_to_quat, quat_to_axisangle", MATRIX, lambda R: its.quat_to_axisangle(its.mat_to_quat(R)))
    yield Function(
        'rmat_to_euler("ZYX")',
        MATRIX,
        lambda R: its.rmat_to_euler(R, "ZYX")[::-1],
        "z-y-x",
        thread="google-deepmind/dm_control#555",
    )
