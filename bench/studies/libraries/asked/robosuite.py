"""robosuite: the error of its operational-space controller, in our loop with its gains.

Its requirements contradict those of the other libraries, so it is asked in an environment of its own.
"""

import json
import math
from functools import partial
from pathlib import Path

import numpy as np
import robosuite
from robosuite.utils import transform_utils
from robosuite.utils.control_utils import orientation_error

from bench.studies.libraries.free_body import accelerated
from bench.studies.libraries.library import MATRIX, QUATERNION, Controller, Function, Library

KP, KV, DT_S = 150.0, 2.0 * math.sqrt(150.0), 0.002
"""OSC_POSE as delivered: kp 150, damping_ratio 1, control at the simulation's 500 Hz."""


def greatest_delta() -> float:
    """Return the largest rotation [rad] about each axis that OSC_POSE takes in one command, as delivered."""
    file = Path(robosuite.__file__).parent / "controllers/config/robots/default_panda.json"
    arm = json.loads(file.read_text(encoding="utf-8"))["body_parts"]["arms"]["right"]
    if arm["input_type"] != "delta":
        raise ValueError(f"{file} sets input_type {arm['input_type']}; this file is written for delta")
    return arm["output_max"][3]


def axis_angle(quat_wxyz) -> np.ndarray:
    """quat2axisangle, which takes (x, y, z, w)."""
    return transform_utils.quat2axisangle(quat_wxyz[[1, 2, 3, 0]])


def matrix_to_axis_angle(R) -> np.ndarray:
    """mat2quat, then quat2axisangle."""
    return transform_utils.quat2axisangle(transform_utils.mat2quat(R))


ERROR = Function("orientation_error", MATRIX, lambda R: orientation_error(R, np.eye(3)), "sine")
OSC = Controller(
    "OSC_POSE, rotation decoupled",
    ERROR.name,
    "acceleration",
    f"kp 150, damping ratio 1, 500 Hz; input as delivered: a delta of at most {greatest_delta():g} rad",
    DT_S,
    partial(accelerated, ERROR, KP, KV, DT_S),
    is_our_loop=True,
)
LIBRARY = Library(
    "robosuite",
    "robosuite",
    (
        ERROR,
        Function("quat2axisangle", QUATERNION, axis_angle),
        Function("mat2quat, quat2axisangle", MATRIX, matrix_to_axis_angle),
    ),
    (OSC,),
)
