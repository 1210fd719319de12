"""An arm's forward kinematics and Jacobian by MuJoCo, and joint paths that turn its tool in place.

    x(q) = (p(q), R(q)),   xdot = (pdot, omega) = J(q) qdot,   dq = J^+ (p_d - p, log(R_d R^T))

The judge's own, to choose starts with: contestants get neither. A path is followed by Newton's method from point to
point; with more than six joints every step is the shortest one (minimum norm). A condition number weighs a metre like
a radian; the arms are about a metre long.

Limitations: a path that comes within about 1e-10 of a singular configuration is given up, and so is one whose points
are so far apart that a joint jumps by more than LARGEST_STEP.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Iterable, Iterator, Sequence

import mujoco
import numpy as np

from tasks.arm_model import Arm, model_xml
from tasks.base import Quat, Start, Vector
from tasks.errors import BadValue
from tasks.linear_algebra import damped, least_norm, length

# |(p_d - p, log(R_d R^T))| at which a pose is reached [m, rad]. Rounding of a chain of seven transformations is about
# 1e-15; Newton's last step squares what is left, so the joints are better than this by as much.
REACHED = 1e-12
# Quadratic convergence from a residual of 0.1 takes 1e-2, 1e-4, 1e-8, 1e-16: five steps, and as many in reserve.
NEWTON_STEPS = 10
# A step of this size [rad] between neighbours of a path is a jump to another branch of solutions.
LARGEST_STEP = 0.5
# The search from afar: it has found the pose when it is so near [m, rad] that Newton's method finishes it ...
NEAR = 1e-2
# ... within so many steps: between random joint angles of our arms, 160 steps find two in a hundred poses more.
SEARCH_STEPS = 40
# lambda at the goal, small beside the squared singular values of a well-conditioned arm (0.05 on a UR5e at home).
DAMPING = 1e-4


Joints = Sequence[float] | np.ndarray
"""One number a joint."""


class Kinematics:
    """MuJoCo's kinematics of one arm, to a site of it, bit for bit that of an episode; q [rad], base frame, SI."""

    def __init__(self, arm: Arm, site: str = "tool"):
        self.arm = arm
        self.model = mujoco.MjModel.from_xml_string(model_xml(arm, 1e-3))
        self.data = mujoco.MjData(self.model)
        self.site = self.model.site(site).id
        self._body = int(self.model.site_bodyid[self.site])
        self._J = np.zeros((6, self.model.nv))
        self._quat = np.zeros(4)

    def pose(self, q: Joints) -> tuple[np.ndarray, Quat]:
        """Return the site's position [m] and orientation."""
        data = self.data
        data.qpos[:] = q
        mujoco.mj_kinematics(self.model, data)
        mujoco.mju_mulQuat(self._quat, data.xquat[self._body], self.model.site_quat[self.site])
        w, x, y, z = self._quat.tolist()
        return data.site_xpos[self.site].copy(), (w, x, y, z)

    def jacobian(self, q: Joints) -> np.ndarray:
        """J, 6 x n: (pdot, omega) = J qdot."""
        self.pose(q)
        return self._jacobian_here().copy()

    def condition(self, q: Joints) -> float:
        """Condition number of J in the 2-norm: largest over smallest singular value, inf if that is zero."""
        s = np.linalg.svd(self.jacobian(q), compute_uv=False)
        return float(s[0] / s[-1]) if s[-1] > 0.0 else math.inf

    def inertia_matrix(self, q: Joints) -> np.ndarray:
        """D, n x n [kg m^2]."""
        self.data.qpos[:], self.data.qvel[:] = q, 0.0
        mujoco.mj_forward(self.model, self.data)
        D = np.zeros((self.model.nv, self.model.nv))
        mujoco.mj_fullM(self.model, self.data, D)
        return D

    def mobility(self, q: Joints) -> np.ndarray:
        """J D^-1 J^T, 6 x 6 [1/kg, 1/(kg m), 1/(kg m^2)]: acceleration of the tool per force and moment on it."""
        J = self.jacobian(q)
        return J @ np.linalg.solve(self.inertia_matrix(q), J.T)

    def least_inertia(self, q: Joints) -> float:
        """Return the tool's inertia about the axis about which a moment turns it most [kg m^2]."""
        return float(1.0 / np.linalg.eigvalsh(self.mobility(q)[3:, 3:])[-1])

    def into_range(self, q: Joints) -> np.ndarray:
        """Return q with each joint moved by whole turns as near to the middle of its range as possible, or to 0."""
        ranges = zip(self.arm.lower, self.arm.upper, strict=True)
        middle = np.array([0.5 * (low + high) if high - low < math.inf else 0.0 for low, high in ranges])
        return np.asarray(q) - math.tau * np.round((np.asarray(q) - middle) / math.tau)

    def within_range(self, q: Joints, margin: float = 0.0) -> bool:
        """Whether every joint is inside its range by at least `margin` [rad]."""
        return all(
            low + margin <= x <= high - margin for x, low, high in zip(q, self.arm.lower, self.arm.upper, strict=True)
        )

    def reach(self, q: Joints, p: np.ndarray, quat: Quat) -> np.ndarray | None:
        """Return the joint angles of a pose, by Newton's method from nearby ones; None if it does not converge."""
        q = np.array(q, dtype=float)
        for _ in range(NEWTON_STEPS):
            error = self.error(q, p, quat)
            if length(error) <= REACHED:
                return q
            step = least_norm(self._jacobian_here(), error)
            if step is None or not abs(step).max() <= LARGEST_STEP:
                return None
            q += step
        return None

    def find(self, q: Joints, p: np.ndarray, quat: Quat) -> np.ndarray | None:
        """Joint angles of a pose from any others, by damped least squares; None if the search ends elsewhere.

        dq = (J^T J + lambda I)^-1 J^T e, lambda = |e|^2/2 + DAMPING (Sugihara 2011, T-RO 27, 984-991): far from the
        pose a descent that no singularity disturbs, near it Newton's method, which finishes.
        """
        q = np.array(q, dtype=float)
        for _ in range(SEARCH_STEPS):
            error = self.error(q, p, quat)
            distance = length(error)
            if distance <= NEAR:
                return self.reach(q, p, quat)
            q += damped(self._jacobian_here(), error, 0.5 * distance * distance + DAMPING)
        return None

    def walk(self, q: Joints, quats: Iterable[Quat]) -> Iterator[np.ndarray]:
        """Yield the joint angles at each orientation in turn, the tool's position held; ends where it cannot go on."""
        p, _ = self.pose(q)
        now = np.array(q, dtype=float)
        for quat in quats:
            reached = self.reach(now, p, quat)
            if reached is None:
                return
            now = reached
            yield now

    def follow(self, q: Joints, quats: Sequence[Quat]) -> np.ndarray | None:
        """All of `walk`, len(quats) x n; None if it ended early."""
        path = list(self.walk(q, quats))
        return np.array(path) if len(path) == len(quats) else None

    def rates(self, q: Joints, omega: Vector) -> np.ndarray:
        """Return the least joint rates [rad/s] at which the tool turns with omega in place; BadValue if singular."""
        found = least_norm(self.jacobian(q), np.array((0.0, 0.0, 0.0, *omega)))
        if found is None:
            raise BadValue(f"{self.arm.name} is singular at q = {list(map(float, q))}; turn it from another pose")
        return found

    def start(self, name: str, q: Joints, goal: Quat, qdot: Joints | None = None, **more: tuple[float, ...]) -> Start:
        """Return a start at these joint angles with MuJoCo's orientation and angular velocity; more: of its fields."""
        angles = tuple(map(float, q))
        rates = tuple(map(float, qdot)) if qdot is not None else (0.0,) * len(angles)
        _, quat = self.pose(angles)
        omega = (0.0, 0.0, 0.0)
        if any(rates):
            self.data.qvel[:] = rates
            mujoco.mj_forward(self.model, self.data)
            x, y, z = self.data.sensordata[9:12].tolist()
            omega = (x, y, z)
        return Start(name, quat, omega, goal, angles, rates, **more)

    def error(self, q: np.ndarray, p: np.ndarray, quat: Quat) -> np.ndarray:
        """(p_d - p, log(R_d R^T)) [m, rad]."""
        here, orientation = self.pose(q)
        return np.array((*(p - here), *rotation_vector(quat, orientation)))

    def _jacobian_here(self) -> np.ndarray:
        """J where `pose` was last called."""
        mujoco.mj_comPos(self.model, self.data)
        mujoco.mj_jacSite(self.model, self.data, self._J[:3], self._J[3:], self.site)
        return self._J


_of_thread = threading.local()


def kinematics(arm: Arm, site: str = "tool") -> Kinematics:
    """Return the Kinematics of an arm, made once in each thread: its state is no two threads' business."""
    made: dict[tuple[Arm, str], Kinematics] = vars(_of_thread).setdefault("made", {})
    if (arm, site) not in made:
        made[arm, site] = Kinematics(arm, site)
    return made[arm, site]


def rotation_vector(to: Quat, of: Quat) -> Vector:
    """log(R(to) R(of)^T): the rotation vector [rad], at most pi long, that turns `of` to `to` in the base frame."""
    s = to[0] * of[0] + to[1] * of[1] + to[2] * of[2] + to[3] * of[3]
    x = -to[0] * of[1] + to[1] * of[0] - to[2] * of[3] + to[3] * of[2]
    y = -to[0] * of[2] + to[2] * of[0] - to[3] * of[1] + to[1] * of[3]
    z = -to[0] * of[3] + to[3] * of[0] - to[1] * of[2] + to[2] * of[1]
    length = math.sqrt(x * x + y * y + z * z)
    # 2 atan2(|v|, s)/|v| tends to 2/s, s = +-1, which is the double nearest to it below |v| = 1e-8
    scale = 2.0 * math.atan2(length, abs(s)) / length if length > 1e-8 else 2.0
    if s < 0.0:
        scale = -scale
    return (scale * x, scale * y, scale * z)
