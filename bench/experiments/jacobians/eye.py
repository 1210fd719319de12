"""An arm as MuJoCo sees it: the tool, the Jacobian, and what a controller is given of a pose."""

from collections.abc import Sequence

import mujoco
import numpy as np

from bench.law.chain import Chain
from bench.law.so3 import Rotation
from tasks.arm_model import Arm, model_xml


class Eye:
    """An arm seen by MuJoCo."""

    def __init__(self, arm: Arm):
        self.model = mujoco.MjModel.from_xml_string(model_xml(arm, 1e-3))
        self.data = mujoco.MjData(self.model)
        self.site = self.model.site("tool").id
        self.n = arm.joints

    def rotation(self, q: Sequence[float] | np.ndarray) -> Rotation:
        """Return the tool's orientation."""
        self.data.qpos[:] = q
        mujoco.mj_kinematics(self.model, self.data)
        m = self.data.site_xmat[self.site]
        return Rotation((m[0], m[3], m[6]), (m[1], m[4], m[7]), (m[2], m[5], m[8]))

    def position(self) -> np.ndarray:
        """Return its position, where `rotation` was last called [m]."""
        return self.data.site_xpos[self.site].copy()

    def look(self, q: Sequence[float] | np.ndarray) -> tuple[Chain, np.ndarray]:
        """Return what a controller sees of a pose, at rest; and J."""
        R = self.rotation(q)
        mujoco.mj_comPos(self.model, self.data)
        J = np.empty((6, self.n))
        mujoco.mj_jacSite(self.model, self.data, J[:3], J[3:], self.site)
        data = self.data
        return Chain(self.n, data.xaxis.copy(), data.xanchor.copy(), np.zeros(self.n), tuple(self.position()), R), J
