"""Libraries of rotations for Python, the laws of this benchmark, and errors of controllers that are restated here."""

import numpy as np

from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library

RESTATED = {
    "franka_ros": "franka-ros",
    "deoxys_control": "deoxys",
    "serl_franka_controllers": "serl-franka",
    "Isaac Gym idiom": "isaac-gym",
    "crisp_controllers": "crisp",
    "cartesian_controllers": "fzi-motion",
}
"""Name in the tables -> word of bench/law/contenders/shipped."""


def scipy() -> list[Library]:
    """Return scipy.spatial.transform.Rotation."""
    from scipy.spatial.transform import Rotation

    of_matrix = Rotation.from_matrix
    vector_part = "2 as_quat, vector part"
    canonical = "`as_quat(canonical=True)`"
    functions = (
        Function("as_rotvec, of a matrix", MATRIX, lambda R: of_matrix(R).as_rotvec()),
        Function(
            "as_rotvec, of a quaternion", QUATERNION, lambda q: Rotation.from_quat(q, scalar_first=True).as_rotvec()
        ),
        Function(vector_part, MATRIX, lambda R: 2.0 * of_matrix(R).as_quat()[:3], "sine-of-half", True, canonical),
        Function("4 as_mrp", MATRIX, lambda R: 4.0 * of_matrix(R).as_mrp(), "mrp"),
        Function('as_euler("ZYX")', MATRIX, lambda R: of_matrix(R).as_euler("ZYX")[::-1], "z-y-x"),
    )
    return [Library("scipy", "scipy", functions)]


def numpy_quaternion() -> list[Library]:
    """Return rotation vectors of quaternions and matrices by numpy-quaternion."""
    import quaternion

    vector, thread = quaternion.as_rotation_vector, "moble/quaternion#58"
    functions = (
        Function("as_rotation_vector", QUATERNION, lambda q: vector(quaternion.quaternion(*q)), thread=thread),
        Function(
            "from_rotation_matrix, as_rotation_vector",
            MATRIX,
            lambda R: vector(quaternion.from_rotation_matrix(R)),
            fix="`-q` where `q.w < 0`, between the two",
            thread=thread,
        ),
    )
    return [Library("numpy-quaternion", "numpy-quaternion", functions)]


def pyquaternion() -> list[Library]:
    """Return axis, angle and logarithm of pyquaternion's Quaternion, which may be made of a matrix."""
    from pyquaternion import Quaternion

    def vector(found) -> np.ndarray:
        return found.angle * found.axis

    def logarithm(q) -> np.ndarray:
        return 2.0 * Quaternion.log(Quaternion(*q)).vector

    functions = (
        Function("angle, axis", QUATERNION, lambda q: vector(Quaternion(*q))),
        Function("angle, axis, of a matrix", MATRIX, lambda R: vector(Quaternion(matrix=R))),
        Function("2 log, vector part", QUATERNION, logarithm, is_idiom=True, fix="`angle * axis`"),
    )
    return [Library("pyquaternion", "pyquaternion", functions)]


def pytransform3d() -> list[Library]:
    """Return pytransform3d.rotations."""
    from pytransform3d import rotations

    def of_matrix(R) -> np.ndarray:
        found = rotations.axis_angle_from_matrix(R)
        return found[3] * found[:3]

    functions = (
        Function("axis_angle_from_matrix", MATRIX, of_matrix, thread="dfki-ric/pytransform3d#43"),
        Function("compact_axis_angle_from_quaternion", QUATERNION, rotations.compact_axis_angle_from_quaternion),
        Function("4 mrp_from_quaternion", QUATERNION, lambda q: 4.0 * rotations.mrp_from_quaternion(q), "mrp"),
    )
    return [Library("pytransform3d", "pytransform3d", functions)]


def transforms3d() -> list[Library]:
    """Return axis and angle of matrices and quaternions by transforms3d, and the angles of ROS's conversions."""
    from transforms3d import axangles, euler, quaternions

    def vector(found) -> np.ndarray:
        axis, angle = found
        return angle * np.asarray(axis)

    functions = (
        Function("mat2axangle", MATRIX, lambda R: vector(axangles.mat2axangle(R))),
        Function("quat2axangle", QUATERNION, lambda q: vector(quaternions.quat2axangle(q))),
        Function("mat2quat, quat2axangle", MATRIX, lambda R: vector(quaternions.quat2axangle(quaternions.mat2quat(R)))),
        Function("mat2euler", MATRIX, lambda R: np.array(euler.mat2euler(R, "sxyz")), "z-y-x"),
    )
    return [Library("transforms3d", "transforms3d", functions)]


def jaxlie() -> list[Library]:
    """Return SO3.log of jaxlie in double precision."""
    import jax
    from jaxlie import SO3

    jax.config.update("jax_enable_x64", True)
    rpy = jax.jit(lambda R: SO3.from_matrix(R).as_rpy_radians())
    functions = (
        Function("SO3.from_matrix, log", MATRIX, jax.jit(lambda R: SO3.from_matrix(R).log())),
        Function("SO3.log", QUATERNION, jax.jit(lambda quat_wxyz: SO3(quat_wxyz).log())),
        Function("SO3.as_rpy_radians", MATRIX, lambda R: np.array(rpy(R)), "z-y-x"),
    )
    return [Library("jaxlie", "jaxlie", functions)]


def spatialmath() -> list[Library]:
    """Return logarithms of Spatial Maths for Python, the difference tr2delta from the identity, and its angles."""
    from spatialmath import SO3, UnitQuaternion, base

    def vector(found) -> np.ndarray:
        theta, axis = found.angvec()
        return theta * axis

    functions = (
        Function("base.trlog", MATRIX, lambda R: base.trlog(R, twist=True)),
        Function("SO3.angvec", MATRIX, lambda R: vector(SO3(R))),
        Function("UnitQuaternion.angvec", QUATERNION, lambda q: vector(UnitQuaternion(q))),
        Function("base.tr2delta", MATRIX, lambda R: base.tr2delta(np.eye(4), base.r2t(R))[3:], "sine"),
        Function('base.tr2rpy(order="zyx")', MATRIX, lambda R: base.tr2rpy(R, order="zyx"), "z-y-x"),
    )
    return [Library("spatialmath", "spatialmath-python", functions)]


def orientation_bench() -> list[Library]:
    """Return laws on R of this benchmark at rest, with kp = 1 and so the error itself."""
    from bench.law.contenders.registry import find_contender
    from bench.law.inputs import AT_REST, Gains, Goal
    from bench.law.so3 import IDENTITY, Rotation

    def law(word: str, form: str) -> Function:
        one, gains = find_contender(word), Gains(kp=1.0, kv=0.0)

        def error(R) -> np.ndarray:
            return np.array(one.law(IDENTITY, AT_REST, Goal(Rotation(*map(tuple, R.T))), gains))

        return Function(word, MATRIX, error, form)

    forms = {
        "rotation-vector": "rotation-vector",
        **dict.fromkeys(("square-root", "quaternion-shortest"), "sine-of-half"),
        **{"mrp": "mrp", "rotation-matrix": "sine"},
    }
    functions = tuple(law(word, form) for word, form in forms.items())
    return [Library("orientation-bench", "orientation-bench", functions)]


def shipped() -> list[Library]:
    """Return orientation errors of controllers that cannot be installed here, each by repository and commit.

    They run with the gains of the suite, so that what differs is the error; with those of their authors the experiment
    `shipped` runs them.
    """
    from bench.law.contenders.registry import contenders

    found = []
    for name, word in RESTATED.items():
        one = contenders("shipped")[word]
        repository, _, revision = one.source.partition("@")
        function = Function(
            "orientation error", QUATERNION, lambda q, error=one.shipped.error: error(tuple(q.tolist()))
        )
        found.append(Library(name, f"{repository}@{revision[:8]}", (function,), is_restated=True))
    return found


ASKED = (
    *(scipy, numpy_quaternion, pyquaternion, pytransform3d, transforms3d, jaxlie, spatialmath),
    *(orientation_bench, shipped),
)
