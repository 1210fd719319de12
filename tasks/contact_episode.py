"""One trial of a task in contact as a dm_control Environment; the order of a tick is that of episode.py.

The reward is 0.0 at every tick: what a trial comes to is said by the judge's metrics, and a learner needs a reward of
its own. Every reset begins the same trial.

F, what the surroundings do to the hand, is known at a tick as MuJoCo computed it in the step before.

Limitations: dm_control raises PhysicsError where MuJoCo warns of a state that is not finite, and MuJoCo's own
FatalError where it cannot go on. An engine that wants a row and no exception prevents the first, judges the state
itself, and catches the second.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from tasks.arm_model import Arm
from tasks.contact import ContactTask, Trial, leg, prepare, refuse
from tasks.contact_checks import check_contact, check_trial
from tasks.contact_model import STANDARD, ContactModel, model_xml
from tasks.discovery import pick
from tasks.episode import INTEGRATORS, Driven, Physics, check, control
from tasks.rules import ticks


class InContact(Driven):
    """Carry out an order; episodes end at the horizon only."""

    def __init__(self, trial: Trial, horizon_ticks: int):
        self.trial = trial
        self.horizon_ticks = horizon_ticks
        self.tick = 0

    def initialize_episode(self, physics: Physics) -> None:
        """Set the state in which the trial begins; the forward pass follows."""
        prepare(physics.model.ptr, physics.data.ptr, self.trial)
        self.tick = 0

    def before_step(self, action: Any, physics: Physics) -> None:
        """Apply the action: the motors' torques [N m]."""
        super().before_step(action, physics)
        pushes = self.trial.pushes
        physics.named.data.xfrc_applied["hand"] = pushes[leg(len(pushes), self.tick, self.horizon_ticks)]
        self.tick += 1

    def get_observation(self, physics: Physics) -> dict[str, np.ndarray]:
        """R, omega [rad/s] and p [m] of the hand, q and qdot of the arm, F = (f, m) [N, N m], base frame.

        R is nine numbers by columns: n, o, a.
        """
        n = len(self.trial.q)
        R = physics.R().reshape(3, 3).T
        gauge = np.array(physics.data.sensordata[19:25])
        return {
            "R": physics.R(),
            "omega": physics.omega(),
            "p": physics.p(),
            "q": np.array(physics.data.qpos[:n]),
            "qdot": np.array(physics.data.qvel[:n]),
            "F": -np.concatenate((R @ gauge[:3], R @ gauge[3:])),
        }

    def get_reward(self, physics: Physics) -> float:
        """0.0 always: the metrics judge a trial, not a reward."""
        return 0.0


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
    doing, limit = InContact(trial, horizon), (horizon - 0.5) * dt
    return control.Environment(physics, doing, time_limit=limit, control_timestep=dt, legacy_step=True)
