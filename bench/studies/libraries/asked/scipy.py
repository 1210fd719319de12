"""SciPy: scipy.spatial.transform.Rotation."""

from scipy.spatial.transform import Rotation

from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library


def of_matrix(R) -> Rotation:
    """Return the Rotation of a matrix."""
    return Rotation.from_matrix(R)


def of_quaternion(quat_wxyz) -> Rotation:
    """Return the Rotation of a quaternion (w, x, y, z)."""
    return Rotation.from_quat(quat_wxyz, scalar_first=True)


LIBRARY = Library(
    "scipy",
    "scipy",
    (
        Function("as_rotvec, of a matrix", MATRIX, lambda R: of_matrix(R).as_rotvec()),
        Function("as_rotvec, of a quaternion", QUATERNION, lambda q: of_quaternion(q).as_rotvec()),
        Function(
            "2 as_quat, vector part",
            MATRIX,
            lambda R: 2.0 * of_matrix(R).as_quat()[:3],
            "sine-of-half",
            True,
            "`as_quat(canonical=True)`",
        ),
        Function("4 as_mrp", MATRIX, lambda R: 4.0 * of_matrix(R).as_mrp(), "mrp"),
        Function('as_euler("ZYX")', MATRIX, lambda R: of_matrix(R).as_euler("ZYX")[::-1], "z-y-x"),
    ),
)
