"""An arm whose tool an orientation spring and damper hold, simulated: what grows is unstable.

The command tau = J_r^T (-K e - D omega) + bias is computed once a control period from MuJoCo's
state, comes late, and is held. Nothing here knows an inertia of the tool or a limit.
"""

import math
from typing import NamedTuple

import mujoco
import numpy as np

STEPS = 4
"""Simulation steps a control period; a delay is a whole number of them."""
BUMP = 1e-6
"""Joint rates at the start [rad/s]: small, so that the motion is linear."""
ROUNDING = 1e-11
"""Rate of the tool [rad/s] below which nothing is left but rounding."""
FAST = 1.0
"""Rate of the tool [rad/s] that no stable loop reaches from BUMP."""


class Spring(NamedTuple):
    """K [N m/rad] and D [N m s/rad] of the orientation; of the position [N/m], [N s/m]."""

    stiffness: float
    damping: float
    position_stiffness: float = 0.0
    position_damping: float = 0.0


class SprungArm:
    """A compiled model with a body as the tool; late: steps from the measurement to the effect."""

    def __init__(self, chain, period, late):
        self.model, self.body, self.late = chain.model, chain.body, late
        self.angles, self.dofs = chain.angles, chain.dofs
        self.data = mujoco.MjData(self.model)
        self.model.opt.timestep = period / STEPS
        self.model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
        without = mujoco.mjtDisableBit.mjDSBL_CONTACT | mujoco.mjtDisableBit.mjDSBL_LIMIT
        self.model.opt.disableflags |= int(without)

    def is_stable(self, pose, spring, ticks=500):
        """Return whether the tool's rate falls from the second quarter of a run to the last."""
        model, data = self.model, self.data
        mujoco.mj_resetData(model, data)
        data.qpos[self.angles] = pose
        data.qvel[self.dofs] = BUMP * np.random.default_rng(1).standard_normal(len(self.dofs))
        mujoco.mj_forward(model, data)
        goal, place = data.xquat[self.body].copy(), data.xpos[self.body].copy()
        data.qfrc_applied[:] = data.qfrc_bias
        pending, rates = [], []
        for step in range(ticks * STEPS):
            if step % STEPS == 0:
                rate, torques = self.command(goal, place, spring)
                rates.append(rate)
                pending.append((step + self.late, torques))
                if not rate < FAST:
                    return False
            while pending and pending[0][0] <= step:
                data.qfrc_applied[:] = pending.pop(0)[1]
            mujoco.mj_step(model, data)
        quarter = ticks // 4
        before, at_end = max(rates[quarter : 2 * quarter]), max(rates[-quarter:])
        return at_end < max(before, ROUNDING)

    def command(self, goal, place, spring):
        """Return the tool's rate [rad/s] and the torques of a tick."""
        model, data = self.model, self.data
        mujoco.mj_fwdPosition(model, data)
        mujoco.mj_fwdVelocity(model, data)
        to_place, to_turn = np.zeros((3, model.nv)), np.zeros((3, model.nv))
        mujoco.mj_jacBody(model, data, to_place, to_turn, self.body)
        inverse, turn, error = np.zeros(4), np.zeros(4), np.zeros(3)
        mujoco.mju_negQuat(inverse, goal)
        mujoco.mju_mulQuat(turn, data.xquat[self.body], inverse)
        mujoco.mju_quat2Vel(error, turn, 1.0)
        omega, velocity = to_turn @ data.qvel, to_place @ data.qvel
        moment = spring.stiffness * error + spring.damping * omega
        away = data.xpos[self.body] - place
        force = spring.position_stiffness * away + spring.position_damping * velocity
        torques = data.qfrc_bias - to_turn.T @ moment - to_place.T @ force
        return math.hypot(*omega), torques
