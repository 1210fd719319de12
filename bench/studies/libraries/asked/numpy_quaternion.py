"""numpy-quaternion: rotation vectors of quaternions and matrices."""

import quaternion

from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library

THREAD = "moble/quaternion#58"

LIBRARY = Library(
    "numpy-quaternion",
    "numpy-quaternion",
    (
        Function(
            "as_rotation_vector",
            QUATERNION,
            lambda q: quaternion.as_rotation_vector(quaternion.quaternion(*q)),
            thread=THREAD,
        ),
        Function(
            "from_rotation_matrix, as_rotation_vector",
            MATRIX,
            lambda R: quaternion.as_rotation_vector(quaternion.from_rotation_matrix(R)),
            fix="`-q` where `q.w < 0`, between the two",
            thread=THREAD,
        ),
    ),
)
