"""Offer the tasks to Gymnasium: import this module, then gymnasium.make("orientation/SurfaceAlignment-v0", arm="ur5e").

The module registers every task under its name: "orientation/FreeBody-v0", "orientation/ArmRegulation-v0", and so on.
gymnasium.make_vec runs many at once. An episode is that of `tasks.load`, with its observation and reward; but each
reset draws another start, and reset(seed=...) repeats what is drawn.
"""

from __future__ import annotations

import dataclasses
from typing import Any

import gymnasium
import mujoco
import numpy as np
from dm_control.rl.control import PhysicsError
from gymnasium.envs.registration import EnvSpec
from gymnasium.spaces import Box, Dict

import tasks
from tasks.contact import Trial
from tasks.rules import ticks

DRAWN = 2**31
"""Number of starts of the free body that a reset draws from; an arm has those of its first start set."""
IDENTIFIERS = {
    f"orientation/{name.title().replace('-', '')}-v0": name for name in (*tasks.names(), *tasks.contact_names())
}
"""Identifiers of Gymnasium, and the names of the tasks."""

LARGEST = float(mujoco.mjMAXVAL)
"""Number of a state beyond which MuJoCo gives up, in SI units: the bound of whatever has no other."""

UNIT = 1.0 + 1e-9
"""Bound of the elements of a rotation matrix, a unit quaternion and a selection of axes; rounding leaves 1e-15."""

BOUNDS = dict.fromkeys(("R", "goal_quat", "selection"), UNIT)


class OrientationEnvironment(gymnasium.Env):
    """A task of this package.

    An action is one number a motor in [-1, 1], times its rated torque [N m]; on the free body times 1000 rad/s^2.
    An observation is a dictionary as in `tasks.load`, base frame; R is nine numbers by columns, goal_quat is
    (w, x, y, z). An episode is truncated at the time limit, and terminated where the simulation diverges. The spec has
    the steps of the time limit as max_episode_steps.

    Args:
        task: a name of `tasks.names()` or `tasks.contact_names()`.
        arm: a name of `tasks.arm_names()`; empty for the free body.
        dt: control period [s]. time_limit: of an episode [s]; None: that of the task.
        render_mode: "rgb_array" or None.
    """

    _spec: EnvSpec | None = None
    metadata = {"render_modes": ["rgb_array"], "render_fps": 50}  # noqa: RUF012  Gymnasium declares it so

    def __init__(
        self, task: str, arm: str, dt: float = 1e-3, time_limit: float | None = None, render_mode: str | None = None
    ):
        self.render_mode, self.arm = render_mode, arm
        self.environment = tasks.load(task, arm=arm, dt=dt, horizon=time_limit)
        self.trials = tasks.contact_task(task).trials(tasks.arm(arm)) if task in tasks.contact_names() else ()
        self.most = self.environment.action_spec().maximum
        self.action_space = Box(-1.0, 1.0, self.most.shape, np.float64)
        seen = self.environment.reset().observation
        self.observation_space = Dict({name: self._find_box(name, one) for name, one in seen.items()})
        self.seen = seen
        usual_s = tasks.contact_task(task).horizon_s if self.trials else tasks.HORIZON_S
        self.steps = ticks(usual_s if time_limit is None else time_limit, dt)

    @staticmethod
    def _find_box(name: str, seen: np.ndarray) -> Box:
        bound = BOUNDS.get(name, LARGEST)
        return Box(-bound, bound, seen.shape, np.float64)

    @property
    def spec(self) -> EnvSpec | None:
        """What Gymnasium knows of the environment, with the number of steps that this one has at most."""
        return self._spec

    @spec.setter
    def spec(self, given: EnvSpec | None) -> None:
        # Not when it is registered: there it would cut episodes of another control period or time limit.
        self._spec = given and dataclasses.replace(given, max_episode_steps=self.steps)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
        """Begin an episode from a start that is drawn, or from options["start"], a Start or in contact a Trial."""
        super().reset(seed=seed)
        start = (options or {}).get("start") or self._draw_start()
        self.environment.task.begin_at(start)
        self.seen = self.environment.reset().observation
        return self._copy_observation(), {"start": start.id}

    def _draw_start(self) -> tasks.Start | Trial:
        if self.trials:
            return self.trials[self.np_random.integers(len(self.trials))]
        if self.arm:
            starts = tasks.start_set(self.environment.task.task.start_sets[0], arm=self.arm)
            return starts[self.np_random.integers(len(starts))]
        drawn = int(self.np_random.integers(DRAWN))
        return tasks.starts_between("uniform", drawn, drawn + 1)[0]

    def step(self, action: np.ndarray) -> tuple[dict[str, np.ndarray], float, bool, bool, dict[str, Any]]:
        """Apply an action for one control period."""
        try:
            step = self.environment.step(np.asarray(action) * self.most)
        except PhysicsError as error:  # the last observation, for a state that is not finite is none
            return self._copy_observation(), 0.0, True, False, {"diverged": str(error)}
        self.seen = step.observation
        return self._copy_observation(), float(step.reward), False, step.last(), {}

    def _copy_observation(self) -> dict[str, np.ndarray]:
        return {name: np.array(one, float) for name, one in self.seen.items()}

    def render(self) -> Any:
        """Return a picture (480 x 640 x 3), or None without a render mode."""
        if self.render_mode is None:
            return None
        return self.environment.physics.render(480, 640, camera_id=0)

    def close(self) -> None:
        """Free the simulation."""
        self.environment.close()


for identifier, name in IDENTIFIERS.items():
    needs_arm = name in tasks.contact_names() or tasks.is_for_arms(name)
    gymnasium.register(
        identifier,
        f"{__name__}:{OrientationEnvironment.__name__}",
        kwargs={"task": name, "arm": "ur5e" if needs_arm else ""},
    )
