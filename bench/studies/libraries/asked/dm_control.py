"""dm_control: dm_control.utils.transformations."""

from absl import logging
from dm_control.utils import transformations

from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library

logging.set_verbosity(logging.ERROR)  # rmat_to_euler warns of every pole it is asked for

LIBRARY = Library(
    "dm_control",
    "dm-control",
    (
        Function("quat_to_axisangle", QUATERNION, transformations.quat_to_axisangle),
        Function(
            "2 quat_log, vector part",
            QUATERNION,
            lambda q: 2.0 * transformations.quat_log(q)[1:],
            is_idiom=True,
            fix="`quat_to_axisangle`",
        ),
        Function(
            "mat_to_quat, quat_to_axisangle",
            MATRIX,
            lambda R: transformations.quat_to_axisangle(transformations.mat_to_quat(R)),
        ),
        Function(
            'rmat_to_euler("ZYX")',
            MATRIX,
            lambda R: transformations.rmat_to_euler(R, "ZYX")[::-1],
            "z-y-x",
            thread="google-deepmind/dm_control#555",
        ),
    ),
)
