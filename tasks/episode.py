"""One episode of any Task as a dm_control Environment.

Order of a tick: observation, law, command, step; MuJoCo sees mj_step1 | command | mj_step2, mj_step1 | ...
(with RK4 mj_step, then mj_step1), which is `legacy_step=True`. With `legacy_step=False` the observation would
be a tick old.

Limitations: dm_control raises PhysicsError once MuJoCo warns of a state that is not finite. An engine that wants a
row and no exception judges the command before the step and the speed after it (verdict.py).
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np

from tasks.base import Quat, Start, Task, angle
from tasks.discovery import pick
from tasks.errors import BadValue
from tasks.rules import ticks
from tasks.sensors import SENSORS

with warnings.catch_warnings():
    # Without a display GLFW only warns, and dm_control keeps a renderer that cannot render. As an error the
    # warning sends it on to EGL; the judge itself never renders.
    warnings.filterwarnings("error", module="glfw")
    from dm_control.mujoco import engine
    from dm_control.rl import control

_WORDS = ("euler", "rk4", "implicit", "implicitfast")
INTEGRATORS = {word: getattr(mujoco.mjtIntegrator, f"mjINT_{word.upper()}") for word in _WORDS}

# A quaternion written with sixteen digits has a norm within 4e-16 of one; one with eight digits does not pass.
UNIT_NORM_TOLERANCE = 1e-9


class Physics(engine.Physics):
    """MuJoCo with the names of our sensors; it knows no rules."""

    def after_reset(self) -> None:
        """Add an mj_step1: dm_control's forward pass runs without actuation, so without motor moments."""
        super().after_reset()
        mujoco.mj_step1(self.model.ptr, self.data.ptr)

    def R(self) -> np.ndarray:
        """Return the columns n, o, a of R, one after the other: 9 numbers."""
        return np.array(self.data.sensordata[0:9])

    def omega(self) -> np.ndarray:
        """Angular velocity, base frame [rad/s]."""
        return np.array(self.data.sensordata[9:12])

    def quat_wxyz(self) -> Quat:
        """Ground truth: MuJoCo's own quaternion, body to base. Not for contestants."""
        w, x, y, z = self.data.sensordata[12:16].tolist()
        return (w, x, y, z)

    def p(self) -> np.ndarray:
        """Position of an arm's tool, base frame [m]."""
        return np.array(self.data.sensordata[16:19])


class Driven(control.Task):
    """Take the model's ctrl as the action; on an arm the motors' torques [N m]."""

    def before_step(self, action: Any, physics: Physics) -> None:
        """Apply the action: the model's ctrl."""
        physics.set_control(action)

    def action_spec(self, physics: Physics) -> Any:
        """Return ctrlrange, on an arm the rated torques [N m]: for agents to draw from, nothing cuts there.

        Limitations: at full torque for half a second, or at random for some, a Panda turns too fast for a step of 1 ms:
        PhysicsError.
        """
        spec = engine.action_spec(physics)
        low, high = physics.model.actuator_ctrlrange.T
        stated = low < high
        return spec.replace(minimum=np.where(stated, low, spec.minimum), maximum=np.where(stated, high, spec.maximum))


class Regulation(Driven):
    """Bring the body from a Start to its goal and keep it there; episodes end at the horizon only."""

    def __init__(self, task: Task, start: Start):
        self.task = task
        self.begin_at(start)

    def begin_at(self, start: Start) -> None:
        """Begin every episode from now on at this start."""
        self.start = start

    def initialize_episode(self, physics: Physics) -> None:
        """Set the state of the start; the forward pass follows."""
        qpos, qvel = self.task.state(self.start)
        physics.data.qpos[:] = qpos
        physics.data.qvel[:] = qvel

    def get_observation(self, physics: Physics) -> dict[str, np.ndarray]:
        """Return R by columns (9), omega [rad/s], goal_quat wxyz; of an arm q, qdot, p and any goal_p [m]."""
        seen = {"R": physics.R(), "omega": physics.omega(), "goal_quat": np.array(self.start.goal_wxyz)}
        if self.task.arm:
            seen |= {"q": np.array(physics.data.qpos), "qdot": np.array(physics.data.qvel), "p": physics.p()}
        if self.start.goal_p:
            seen["goal_p"] = np.array(self.start.goal_p)
        return seen

    def get_reward(self, physics: Physics) -> float:
        """Minus the judge's angle to the goal [rad]."""
        return -angle(physics.quat_wxyz(), self.start.goal_wxyz)


def environment(
    task: Task,
    start: Start,
    dt: float,
    horizon: float,
    integrator: str,
    vary: Callable[[mujoco.MjModel], None] | None = None,
) -> control.Environment:
    """See `tasks.load`, which takes names."""
    check(dt, horizon, start)
    physics = Physics.from_xml_string(task.xml(dt))
    physics.model.opt.integrator = pick("integrator", integrator, INTEGRATORS, "tasks/episode.py")
    _check_sensors(task, physics)
    if task.arm:
        _check_joints(task, start, physics)
    if vary:
        vary(physics.model.ptr)
    # Half a tick less than the horizon: dm_control counts steps >= limit / dt, and 3 * 0.1 / 0.1 is above 3.
    limit = (ticks(horizon, dt) - 0.5) * dt
    return control.Environment(
        physics, Regulation(task, start), time_limit=limit, control_timestep=dt, legacy_step=True
    )


def check(dt: float, horizon: float, *starts: Start) -> None:
    """BadValue if they are no control period, no length of an episode [s], or no start on a free body."""
    if not (math.isfinite(dt) and dt > 0.0):
        raise BadValue(f"dt = {dt} s is not a control period: give a finite number above 0 (try: dt=1e-3)")
    if not (math.isfinite(horizon) and horizon >= dt):
        raise BadValue(f"horizon = {horizon} s is not finite or shorter than dt = {dt} s (try: horizon=20.0)")
    for start in starts:
        for what, quat in (("quat_wxyz", start.quat_wxyz), ("goal_wxyz", start.goal_wxyz)):
            if len(quat) != 4 or not abs(math.hypot(*quat) - 1.0) <= UNIT_NORM_TOLERANCE:
                raise BadValue(
                    f"start '{start.id}': {what} = {tuple(quat)} is no unit quaternion wxyz (divide it by its norm)"
                )
        if len(start.omega) != 3 or not all(map(math.isfinite, start.omega)):
            raise BadValue(f"start '{start.id}': omega = {tuple(start.omega)} must be three finite numbers [rad/s]")


def _check_sensors(task: Task, physics: Physics) -> None:
    model = physics.model
    found = [(model.id2name(i, "sensor"), int(model.sensor_dim[i])) for i in range(model.nsensor)]
    wanted = [(name, size) for name, _, size in SENSORS]
    if found[: len(wanted)] != wanted:
        raise BadValue(f"task '{task.name}': first sensors are {found}, not {wanted} (use tasks.sensors.sensor_xml)")


def _check_joints(task: Task, start: Start, physics: Physics) -> None:
    n = physics.model.nq
    for what, numbers in (("q", start.q), ("qdot", start.qdot)):
        if len(numbers) != n or not all(map(math.isfinite, numbers)):
            raise BadValue(
                f"start '{start.id}': {what} = {tuple(numbers)} must be {n} finite numbers on arm '{task.arm}' "
                f"(try: tasks.start_set('{task.start_sets[0]}', arm='{task.arm}'))"
            )
