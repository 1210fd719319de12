"""One trial of a task in contact as a dm_control Environment; the order of a tick is that of episode.py.

The reward says how far the hand is from what is specified; the judge's metrics do not use it.

F, what the surroundings do to the hand, is known at a tick as MuJoCo computed it in the step before.

Limitations: dm_control raises PhysicsError where MuJoCo warns of a state that is not finite, and MuJoCo's own
FatalError where it cannot go on. An engine that wants a row and no exception prevents the first, judges the state
itself, and catches the second.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np

from tasks.arm_model import Arm
from tasks.contact import ContactTask, Trial, leg, prepare, refuse
from tasks.contact_checks import check_contact, check_trial
from tasks.contact_model import STANDARD, ContactModel, model_xml
from tasks.discovery import pick
from tasks.episode import INTEGRATORS, Driven, Physics, check, control
from tasks.rotations import to_base
from tasks.rules import ticks

LENGTH_M, STIFFNESS = 0.1, 1000.0
"""What makes errors of the reward forces: moments are over this length, deviations times this stiffness [N/m]."""


class DrivenInContact(Driven):
    """Carry out an order; episodes end at the horizon only."""

    def __init__(self, trial: Trial, horizon_ticks: int):
        self.horizon_ticks = horizon_ticks
        self.begin_at(trial)

    def begin_at(self, trial: Trial) -> None:
        """Begin every episode from now on with this trial of the same task and arm."""
        self.trial, self.tick, self.first_p = trial, 0, np.zeros(3)

    def initialize_episode(self, physics: Physics) -> None:
        """Set the state in which the trial begins; the forward pass follows."""
        prepare(physics.model.ptr, physics.data.ptr, self.trial)
        mujoco.mj_kinematics(physics.model.ptr, physics.data.ptr)
        self.tick, self.first_p = 0, np.array(physics.named.data.site_xpos["hand"])

    def before_step(self, action: Any, physics: Physics) -> None:
        """Apply the action: the motors' torques [N m]."""
        super().before_step(action, physics)
        pushes = self.trial.pushes
        physics.named.data.xfrc_applied["hand"] = pushes[leg(len(pushes), self.tick, self.horizon_ticks)]
        self.tick += 1

    def get_observation(self, physics: Physics) -> dict[str, np.ndarray]:
        """R, omega [rad/s] and p [m] of the hand, q and qdot of the arm, F = (f, m) [N, N m], base frame.

        R is nine numbers by columns: n, o, a. What is specified: goal_quat (w, x, y, z) and goal_p [m], where the hand
        is held, selection and desired_wrench as in `Specification`.
        """
        n, specification = len(self.trial.q), self.trial.specification
        return {
            "R": physics.R(),
            "omega": physics.omega(),
            "p": physics.p(),
            "q": np.array(physics.data.qpos[:n]),
            "qdot": np.array(physics.data.qvel[:n]),
            "F": self.find_wrench(physics),
            "goal_quat": np.array(self.trial.goal_wxyz),
            "goal_p": self.find_goal_position(physics),
            "selection": np.array(specification.selection, float),
            "desired_wrench": np.array(specification.desired_wrench),
        }

    def find_wrench(self, physics: Physics) -> np.ndarray:
        """Return F = (f, m), what the surroundings do to the hand [N, N m], base frame."""
        R, gauge = physics.R().reshape(3, 3).T, np.array(physics.data.sensordata[19:25])
        return -np.concatenate((R @ gauge[:3], R @ gauge[3:]))

    def find_goal_position(self, physics: Physics) -> np.ndarray:
        """Return the place at which the hand is held now [m], base frame."""
        moved_s = min(self.tick * physics.timestep(), self.trial.specification.moves_s)
        return self.first_p + moved_s * np.array(self.trial.specification.velocity)

    def get_reward(self, physics: Physics) -> float:
        """Minus the size of the error of what is specified [N].

        Along axes that comply it is F + desired wrench, (f, m/L); along axes that are held K (p - p_d, L e), where e is
        the rotation vector from the goal to the hand, L is LENGTH_M and K is STIFFNESS.
        """
        specification, turned = self.trial.specification, np.zeros(3)
        mujoco.mju_subQuat(turned, np.array(physics.quat_wxyz()), np.array(self.trial.goal_wxyz))  # in the goal's frame
        x, y, z = turned.tolist()
        away = np.hstack((physics.p() - self.find_goal_position(physics), to_base(self.trial.goal_wxyz, (x, y, z))))
        wrench = self.find_wrench(physics) + specification.desired_wrench
        lengths = np.repeat((1.0, LENGTH_M), 3)
        errors = np.where(specification.selection, STIFFNESS * lengths * away, wrench / lengths)
        return -float(np.linalg.norm(errors))


def environment(
    task: ContactTask,
    arm: Arm,
    trial: Trial | None = None,
    dt: float = 1e-3,
    integrator: str = "implicitfast",
    contact: ContactModel = STANDARD,
    vary: Callable[[Any], None] | None = None,
) -> control.Environment:
    """Return a dm_control Environment of one trial, the first if none is given; `vary` as in `tasks.load`.

    Errors:
        BadValue: the arm cannot be set the task, or the trial or the contact model is none.
    """
    refuse(task, arm)
    trial = task.trials(arm)[0] if trial is None else trial
    check(dt, task.horizon_s)
    check_trial(trial, arm)
    check_contact(contact)
    physics = Physics.from_xml_string(model_xml(task, arm, dt, contact))
    physics.model.opt.integrator = pick("integrator", integrator, INTEGRATORS, "tasks/episode.py")
    if vary:
        vary(physics.model.ptr)
    horizon = ticks(task.horizon_s, dt)
    doing, limit = DrivenInContact(trial, horizon), (horizon - 0.5) * dt
    return control.Environment(physics, doing, time_limit=limit, control_timestep=dt, legacy_step=True)
