"""What an arm's episode costs when it is written as one would: dm_control's Environment.step and a law in numpy.

(2.2) with the law on R: torques from mj_jacSite, mj_jacDot, mj_fullM and numpy.linalg, and a step a tick, with the
observation and reward that dm_control makes of it. The compiled loop's speed-up is over this.

Limitations: where J is singular; numpy then raises or gives torques without bound.
"""

from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np

import tasks
from bench.law.inputs import Gains
from bench.law.so3 import from_quaternion
from tasks.base import Start

HORIZON_S = 1000.0
"""Longer than any timing."""


class Controller:
    """tau = D J^+ (a - J z) + D z + fg with a = (u_p, u) - Jdot qdot; on seven joints z = -Kv/2 qdot, else 0."""

    def __init__(self, physics: Any, start: Start, gains: Gains) -> None:
        self.model, self.data = physics.model.ptr, physics.data.ptr
        self.gains = gains
        site = self.model.site("tool").id
        self.site, self.body = site, int(self.model.site_bodyid[site])
        self.p_d = self.data.site_xpos[site].copy()
        self.R_d = np.array(from_quaternion(start.goal_wxyz)).T
        n = self.model.nv
        self.J, self.Jdot, self.D = np.zeros((6, n)), np.zeros((6, n)), np.zeros((n, n))

    def torques(self) -> np.ndarray:
        """tau [N m] in the state that the physics is in."""
        m, d, J = self.model, self.data, self.J
        mujoco.mj_jacSite(m, d, J[:3], J[3:], self.site)
        mujoco.mj_jacDot(m, d, self.Jdot[:3], self.Jdot[3:], d.site_xpos[self.site], self.body)
        mujoco.mj_fullM(m, d, self.D)
        xdot = J @ d.qvel
        R = d.site_xmat[self.site].reshape(3, 3)
        e = 0.5 * np.cross(R, self.R_d, axis=0).sum(axis=1)
        error = np.concatenate((self.p_d - d.site_xpos[self.site], e))
        a = self.gains.kp * error - self.gains.kv * xdot - self.Jdot @ d.qvel
        if m.nv == 6:
            qddot = np.linalg.solve(J, a)
        else:
            z = -0.5 * self.gains.kv * d.qvel
            qddot = np.linalg.pinv(J) @ (a - J @ z) + z
        return self.D @ qddot + d.qfrc_bias - d.qfrc_passive


def loop(task: str, arm: str, start: Start, dt_s: float, ticks: int, gains: Gains) -> Callable:
    """Return a function that goes on with one long episode by so many ticks, whose cost does not change with time."""
    environment = tasks.load(task, start=start, dt=dt_s, horizon=HORIZON_S, arm=arm)
    environment.reset()
    controller = Controller(environment.physics, start, gains)

    def call() -> None:
        for _ in range(ticks):
            environment.step(controller.torques())

    return call
