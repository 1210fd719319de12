"""MuJoCo: its functions on quaternions, and what its constraints and actuators make of them."""

from collections.abc import Iterator
from functools import partial

import mujoco
import numpy as np

from bench.studies.libraries.free_body import conjugate
from bench.studies.libraries.library import MATRIX, QUATERNION, Controller, Function, Library

BODY = """
<body name="body"><joint type="ball"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/><site name="body"/></body>
"""
ACTUATED = mujoco.MjModel.from_xml_string(f"""
<mujoco><worldbody><site name="goal"/>{BODY}</worldbody>
<actuator><orientation site="body" refsite="goal" kp="1"/></actuator></mujoco>
""")
HELD = mujoco.MjModel.from_xml_string(f"""
<mujoco><option timestep="0.001" gravity="0 0 0"/><worldbody><site name="goal"/>{BODY}</worldbody>
<actuator><orientation site="body" refsite="goal" kp="100" kv="20"/></actuator></mujoco>
""")
WELDED = mujoco.MjModel.from_xml_string(f"""
<mujoco><option gravity="0 0 0"/><worldbody><body name="goal" mocap="true"/>{BODY}</worldbody>
<equality><weld body1="goal" body2="body" relpose="0 0 0 1 0 0 0"/></equality></mujoco>
""")
DATA = {model: mujoco.MjData(model) for model in (ACTUATED, WELDED)}
IDENTITY = np.array((1.0, 0.0, 0.0, 0.0))


def sub_quat(quat_wxyz) -> np.ndarray:
    """mju_subQuat, the difference of two quaternions that mj_differentiatePos takes."""
    e = np.empty(3)
    mujoco.mju_subQuat(e, quat_wxyz, IDENTITY)
    return e


def quat_to_vel(quat_wxyz) -> np.ndarray:
    """mju_quat2Vel over one second."""
    e = np.empty(3)
    mujoco.mju_quat2Vel(e, quat_wxyz, 1.0)
    return e


def mat_to_quat(R) -> np.ndarray:
    """Twice the vector part of mju_mat2Quat, with no look at the sign of the scalar."""
    quat_wxyz = np.empty(4)
    mujoco.mju_mat2Quat(quat_wxyz, np.ascontiguousarray(R).ravel())
    return 2.0 * quat_wxyz[1:]


def mat_to_vel(R) -> np.ndarray:
    """mju_mat2Quat, then mju_quat2Vel: what operational-space controllers on MuJoCo do."""
    quat_wxyz = np.empty(4)
    mujoco.mju_mat2Quat(quat_wxyz, np.ascontiguousarray(R).ravel())
    return quat_to_vel(quat_wxyz)


def forward(model, quat_wxyz) -> mujoco.MjData:
    """The model's data with its body turned so."""
    data = DATA[model]
    data.qpos[:] = quat_wxyz
    mujoco.mj_forward(model, data)
    return data


def orientation_actuator(quat_wxyz) -> np.ndarray:
    """Minus the force of the three <orientation> actuators with kp = 1 on a body that is turned so, in its frame."""
    return -forward(ACTUATED, quat_wxyz).qfrc_actuator


def weld_pull(quat_wxyz) -> np.ndarray:
    """Return the acceleration from rest of a welded body; its residual is |efc_pos| = sin(theta/2)."""
    return forward(WELDED, quat_wxyz).qacc.copy()


def stepped(model, quat_wxyz) -> Iterator[tuple]:
    """Step a model of one body of unit inertia from rest until it neither moves nor accelerates."""
    data = mujoco.MjData(model)
    data.qpos[:] = conjugate(quat_wxyz)
    while True:
        yield conjugate(tuple(data.qpos))
        mujoco.mj_step(model, data)
        if not data.qvel.any() and not data.qacc.any():
            return


def numbers(values) -> str:
    """Return numbers in as few digits as they need."""
    return " ".join(f"{value:g}" for value in values)


LIBRARY = Library(
    "mujoco",
    "mujoco",
    (
        Function("mju_subQuat", QUATERNION, sub_quat),
        Function("mju_quat2Vel", QUATERNION, quat_to_vel),
        Function("mju_mat2Quat, mju_quat2Vel", MATRIX, mat_to_vel),
        Function("2 mju_mat2Quat, vector part", MATRIX, mat_to_quat, "sine-of-half", True, "`mju_quat2Vel` of it"),
        Function("<orientation> actuator", QUATERNION, orientation_actuator),
    ),
    (
        Controller(
            "<orientation> actuators",
            "<orientation> actuator",
            "acceleration",
            "kp 100, kv 20, timestep 1 ms",
            HELD.opt.timestep,
            partial(stepped, HELD),
        ),
        Controller(
            "<weld>, by default",
            "",
            "acceleration",
            f"solref {numbers(WELDED.eq_solref[0])}, solimp {numbers(WELDED.eq_solimp[0])}, "
            f"timestep {1e3 * WELDED.opt.timestep:g} ms",
            WELDED.opt.timestep,
            partial(stepped, WELDED),
            weld_pull,
        ),
    ),
)
