"""Compute the rotational inertia that an orientation spring on an arm's tool feels.

The controller sends tau = J_r^T (-K e - D omega) + what the arm needs at rest, and shapes no
inertia; J_r are the rows of the Jacobian with omega = J_r qdot. Near the goal the tool then moves
as

    Lambda domega/dt = -K e - D omega,   Lambda = (J_r M^-1 J_r^T)^-1   [kg m^2]

with the tool's position free: this is what a torque on the tool meets at once, whatever holds the
position later. With the position held rigidly it is the rotational block of (J M^-1 J^T)^-1, which
is more. The eigenvalues of Lambda are the inertias about three axes, and with scalars K and D each
axis is a loop of its own.

Poses are drawn uniformly between the ends of the joint ranges. A pose is left out if its joints
turn more than QUICKEST times as fast as the tool about some axis: 1 over the least singular value
of J_r, a number without unit.

Limitations: hits of the arm with itself or the floor are not looked for. Joint friction and damping
are left out.
"""

from __future__ import annotations

from typing import NamedTuple

import mujoco
import numpy as np

from bench.base.errors import Incompatible
from bench.findings.selection.tool_chain import ToolChain
from tasks.clearance import CONDITION

POSES = 2000
"""Poses drawn: against five times as many the least inertia errs by 3 %, the 95 % by some 10 %."""

SEED = 2026

QUICKEST = 5.0
"""Joint rate over the tool's rate from which on a pose counts as singular; it is usually 1 to 2."""

FEWEST = 50
"""Poses that must be left, for 5 and 95 % to mean something."""

ENDS = (5.0, 95.0)
"""The percentiles that are called the range."""

ROTATION = slice(3, 6)
TASK_AXES = 6


class Felt(NamedTuple):
    """Inertias over the workspace [kg m^2].

    poses: joint positions, shape (poses, joints). moments: about three axes of each pose,
    ascending, shape (poses, 3). held: the same with the position held, of the poses where J is well
    conditioned, shape (some, 3); empty with fewer than six joints. drawn: how many poses were
    drawn.
    """

    poses: np.ndarray
    moments: np.ndarray
    held: np.ndarray
    drawn: int

    @property
    def ends(self) -> tuple[float, float]:
        """Return the 5 and the 95 % of all axes and poses."""
        low, high = np.percentile(self.moments, ENDS)
        return float(low), float(high)

    @property
    def held_ends(self) -> tuple[float, float] | None:
        """Return the 5 and the 95 % with the position held; None if nothing was computed."""
        if len(self.held) < FEWEST:
            return None
        low, high = np.percentile(self.held, ENDS)
        return float(low), float(high)

    @property
    def least(self) -> float:
        """Return the smallest inertia of all poses."""
        return float(self.moments.min())

    @property
    def most(self) -> float:
        """Return the greatest inertia of all poses."""
        return float(self.moments.max())

    @property
    def lightest(self) -> np.ndarray:
        """Return the pose of the smallest inertia."""
        return self.poses[int(np.argmin(self.moments[:, 0]))]

    @property
    def unevenness(self) -> float:
        """Return the median of s, with 1 - s and 1 + s the extreme inertias over their mean."""
        low, high = self.moments[:, 0], self.moments[:, 2]
        return float(np.median((high - low) / (high + low)))


def feel(chain: ToolChain, count: int = POSES, seed: int = SEED) -> Felt:
    """Return the inertias of drawn poses; Incompatible if too few of them are regular."""
    mechanics = Mechanics(chain)
    low, high = chain.ranges()
    drawn = np.random.default_rng(seed).uniform(low, high, (count, len(low)))
    poses, moments, held = [], [], []
    for pose in drawn:
        J, M = mechanics.look(pose)
        if not is_regular(J):
            continue
        mobility = J @ np.linalg.solve(M, J.T)
        poses.append(pose)
        moments.append(_invert(mobility[ROTATION, ROTATION]))
        if len(pose) >= TASK_AXES and np.linalg.cond(J) <= CONDITION:
            held.append(np.linalg.eigvalsh(np.linalg.inv(mobility)[ROTATION, ROTATION]))
    if len(poses) < FEWEST:
        raise Incompatible(
            f"{chain.title}: {chain.effector} turns freely about every axis in {len(poses)} of "
            f"{count} drawn poses, and it takes {FEWEST} (name an end effector with three joint "
            "axes that are not in one plane)"
        )
    return Felt(np.array(poses), np.array(moments), np.reshape(held, (-1, 3)), count)


def is_regular(J: np.ndarray) -> bool:
    """Tell whether joints turn at most QUICKEST times as fast as the tool; J: 6 x n."""
    least = np.linalg.svd(J[ROTATION], compute_uv=False)[-1]
    return bool(least * QUICKEST >= 1.0)


def _invert(mobility: np.ndarray) -> np.ndarray:
    """Return the eigenvalues of the inverse of a symmetric matrix, ascending."""
    return 1.0 / np.linalg.eigvalsh(mobility)[::-1]


class Mechanics:
    """Jacobian and inertia matrix of a chain by MuJoCo, the other joints locked."""

    def __init__(self, chain: ToolChain):
        self.chain = chain
        self.data = mujoco.MjData(chain.model)
        size = chain.model.nv
        self._J = np.zeros((TASK_AXES, size))
        self._M = np.zeros((size, size))

    def look(self, pose: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return J, 6 x n, position first, and M, n x n, of the chain's joints at a pose."""
        chain, model, data = self.chain, self.chain.model, self.data
        data.qpos[chain.angles] = pose
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_makeM(model, data)
        mujoco.mj_fullM(model, data, self._M)
        orientation = data.xmat[chain.body].reshape(3, 3)
        point = data.xpos[chain.body] + orientation @ np.array(chain.point)
        mujoco.mj_jac(model, data, self._J[:3], self._J[ROTATION], point, chain.body)
        dofs = chain.dofs
        return self._J[:, dofs], self._M[np.ix_(dofs, dofs)]
