"""Tasks in contact under any controller of torques: MuJoCo's steps, and the arm as Python sees it at a tick."""

from collections.abc import Callable
from typing import NamedTuple

import mujoco
import numpy as np

import tasks
from bench.engines.contact_episode import USUAL, sensors_of
from bench.engines.metrics.contact_metric import Response
from bench.engines.native.libmujoco import MUJOCO_INTEGRATORS
from bench.studies.contact.stability import contact
from tasks.contact import ContactTask, Trial, prepare
from tasks.contact_model import STANDARD, ContactModel, model_xml
from tasks.kinematics import rotation_vector

FARTHEST_M, FASTEST = 1.0, 1e3
"""A hand that is further from its place [m], or joints that are faster [rad/s], are lost."""


class Tick(NamedTuple):
    """J (6 x n), M (n x n), bias less what friction takes of it, gravity alone [N m], and qdot.

    p, R: of the hand. error: (p_d - p, log(R_d R^T)) [m, rad]; twist: (pdot, omega), rate: v_d less it; wrench: what is
    done to the hand, as it was in the step before [N, N m]; wanted: the commanded wrench. All in the base frame. gap
    and turned: as in `Response` [m], [rad].
    """

    J: np.ndarray
    M: np.ndarray
    bias: np.ndarray
    gravity: np.ndarray
    qdot: np.ndarray
    p: np.ndarray
    R: np.ndarray
    error: np.ndarray
    twist: np.ndarray
    rate: np.ndarray
    wrench: np.ndarray
    wanted: np.ndarray
    gap: float
    turned: float


Torque = Callable[[Tick], np.ndarray]
"""Torques of the joints [N m]."""


def episode(
    task: ContactTask, name: str, trial: Trial, torque: Torque, horizon_s: float, surface: ContactModel = STANDARD
) -> list[Tick]:
    """Return the ticks of an episode on an arm; fewer if the hand is lost."""
    arm, dt = tasks.arm(name), USUAL.dt_s
    model = mujoco.MjModel.from_xml_string(model_xml(task, arm, dt, surface))
    model.opt.integrator = MUJOCO_INTEGRATORS[USUAL.integrator]
    data, still = mujoco.MjData(model), mujoco.MjData(model)
    for one in (data, still):
        prepare(model, one, trial)
    mujoco.mj_forward(model, data)
    mujoco.mj_step1(model, data)
    site, n, specification = model.site("hand").id, arm.joints, trial.specification
    gap, turned = sensors_of(model)
    J, M, s = np.zeros((6, model.nv)), np.zeros((model.nv, model.nv)), data.sensordata
    p_0, wanted, found = data.site_xpos[site].copy(), np.array(specification.desired_wrench, dtype=float), []
    for tick in range(round(horizon_s / dt)):
        moved_s = min(tick * dt, specification.moves_s)
        v_d = np.zeros(6)
        if tick * dt < specification.moves_s:
            v_d[:3] = specification.velocity
        mujoco.mj_jacSite(model, data, J[:3], J[3:], site)
        mujoco.mj_fullM(model, data, M)
        still.qpos[:] = data.qpos
        mujoco.mj_step1(model, still)
        R, p, twist = data.site_xmat[site].reshape(3, 3).copy(), s[16:19].copy(), J[:, :n] @ data.qvel[:n]
        turn = rotation_vector(trial.goal_wxyz, (s[12], s[13], s[14], s[15]))
        error = np.concatenate((p_0 + moved_s * np.array(specification.velocity) - p, turn))
        wrench = -np.concatenate((R @ s[19:22], R @ s[22:25]))
        now = Tick(
            J[:, :n].copy(),
            M[:n, :n].copy(),
            (data.qfrc_bias - data.qfrc_passive)[:n],
            still.qfrc_bias[:n].copy(),
            data.qvel[:n].copy(),
            p,
            R,
            error,
            twist,
            v_d - twist,
            wrench,
            wanted,
            float(s[gap]) if gap >= 0 else 0.0,
            float(s[turned]) if turned >= 0 else 0.0,
        )
        found.append(now)
        data.ctrl[:n] = torque(now)
        mujoco.mj_step2(model, data)
        mujoco.mj_step1(model, data)
        if not np.linalg.norm(data.qvel) < FASTEST or np.linalg.norm(error[:3]) > FARTHEST_M:
            break
    return found


def press(name: str, stiffness: float, torque: Torque, horizon_s: float) -> list[Tick]:
    """Return the ticks of a press on a level plane of this stiffness [N/m] from a millimetre over it."""
    task = tasks.contact_task("force-on-plane")
    trial = task.trials(tasks.arm(name))[0]
    still = trial.specification._replace(velocity=(0.0, 0.0, 0.0), desired_wrench=(0.0,) * 6)
    return episode(task, name, trial._replace(specification=still), torque, horizon_s, contact(stiffness))


def response(trial: Trial, ticks: list[Tick], horizon_s: float) -> Response:
    """Return the episode as metrics of contact take it; its load is none of theirs here."""

    def each(name: str) -> np.ndarray:
        return np.array([getattr(now, name) for now in ticks])

    wrench, twist = each("wrench"), each("twist")
    return Response(
        trial,
        "done" if len(ticks) == round(horizon_s / USUAL.dt_s) else "diverged",
        USUAL.dt_s * np.arange(len(ticks)),
        each("R"),
        twist[:, 3:],
        each("p"),
        wrench[:, :3],
        wrench[:, 3:],
        each("gap"),
        each("turned"),
        np.full(len(ticks), np.nan),
    )
