"""A tip that any controller presses on a level plane: MuJoCo's steps, and the arm as Python sees it at a tick."""

from collections.abc import Callable
from typing import NamedTuple

import mujoco
import numpy as np

import tasks
from bench.engines.contact_episode import USUAL
from bench.engines.native.libmujoco import MUJOCO_INTEGRATORS
from bench.studies.contact.stability import contact
from tasks.base import Quat
from tasks.contact import prepare
from tasks.contact_model import model_xml
from tasks.kinematics import rotation_vector

FARTHEST_M, FASTEST = 1.0, 1e3
"""A hand that is further from its place [m], or joints that are faster [rad/s], are lost."""


class Tick(NamedTuple):
    """J (6 x n) and M (n x n) of the hand; bias and what friction takes of it, gravity alone [N m]; q and qdot.

    error: (p_d - p, log(R_d R^T)) of where the hand began [m, rad]; twist: (pdot, omega); wrench: what the plane does
    to the hand, as it was in the step before [N, N m]. All in the base frame.
    """

    J: np.ndarray
    M: np.ndarray
    bias: np.ndarray
    gravity: np.ndarray
    qdot: np.ndarray
    error: np.ndarray
    twist: np.ndarray
    wrench: np.ndarray


def press(name: str, stiffness: float, torque: Callable[[Tick], np.ndarray], horizon_s: float) -> list[Tick]:
    """The ticks of an episode that begins a millimetre over the plane; fewer if the hand is lost.

    Args:
        name: the arm. stiffness: of the plane [N/m]. torque: of the joints [N m].
    """
    task, arm = tasks.contact_task("force-on-plane"), tasks.arm(name)
    trial = task.trials(arm)[0]
    model = mujoco.MjModel.from_xml_string(model_xml(task, arm, USUAL.dt_s, contact(stiffness)))
    model.opt.integrator = MUJOCO_INTEGRATORS[USUAL.integrator]
    data, still = mujoco.MjData(model), mujoco.MjData(model)
    for one in (data, still):
        prepare(model, one, trial)
    mujoco.mj_forward(model, data)
    mujoco.mj_step1(model, data)
    site, n = model.site("hand").id, arm.joints
    J, M = np.zeros((6, model.nv)), np.zeros((model.nv, model.nv))
    p_d, found = data.site_xpos[site].copy(), []
    for _ in range(round(horizon_s / USUAL.dt_s)):
        mujoco.mj_jacSite(model, data, J[:3], J[3:], site)
        mujoco.mj_fullM(model, data, M)
        still.qpos[:] = data.qpos
        mujoco.mj_step1(model, still)
        s = data.sensordata
        R = data.site_xmat[site].reshape(3, 3)
        quat: Quat = (s[12], s[13], s[14], s[15])
        error = np.concatenate((p_d - s[16:19], rotation_vector(trial.goal_wxyz, quat)))
        wrench = -np.concatenate((R @ s[19:22], R @ s[22:25]))
        bias = data.qfrc_bias - data.qfrc_passive
        now = Tick(J.copy(), M.copy(), bias, still.qfrc_bias.copy(), data.qvel.copy(), error, J @ data.qvel, wrench)
        found.append(now)
        data.ctrl[:n] = torque(now)
        mujoco.mj_step2(model, data)
        mujoco.mj_step1(model, data)
        if not np.linalg.norm(data.qvel) < FASTEST or np.linalg.norm(error[:3]) > FARTHEST_M:
            break
    return found
