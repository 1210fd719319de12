"""An arm as MuJoCo sees it: the tool, the Jacobian, and what a controller is given of a pose."""

from collections.abc import Sequence

import numpy as np

from bench.law.chain import Chain
from bench.law.so3 import Rotation
from tasks.kinematics import Kinematics


class Eye(Kinematics):
    """An arm seen by MuJoCo."""

    def place(self, q: Sequence[float] | np.ndarray) -> tuple[np.ndarray, Rotation]:
        """Return the tool's position [m] and orientation as MuJoCo's matrix."""
        p, _ = self.pose(q)
        m = self.data.site_xmat[self.site]
        return p, Rotation((m[0], m[3], m[6]), (m[1], m[4], m[7]), (m[2], m[5], m[8]))

    def look(self, q: Sequence[float] | np.ndarray) -> tuple[Chain, np.ndarray]:
        """Return what a controller sees of a pose, at rest; and J."""
        J, n, (p, R) = self.jacobian(q), self.arm.joints, self.place(q)
        return Chain(n, self.data.xaxis.copy(), self.data.xanchor.copy(), np.zeros(n), tuple(p), R), J
