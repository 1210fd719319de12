"""How a hand's frame is drawn on the hand, and what stands askew before it.

Trials in contact begin at home, where our arms point the wrist down and are well conditioned.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable

from tasks.arm_model import Arm
from tasks.base import Quat, Vector
from tasks.contact import Specification, Trial
from tasks.rotations import about, multiply, to_base, zyx

UP: Quat = (0.0, 1.0, 0.0, 0.0)  # turns the wrist's frame, which points down, so that z points up
BETAS, DENSE_BETAS = (0, 45, 75), (-60, 0, 30, 45, 60, 75)
"""Frames of the hand of the tasks in contact, R = Ry(beta) at the goal, on a coarse grid and a dense one [deg]."""

Stands = Callable[[Quat, float], tuple[Specification, Vector, Quat]]
"""Specification of a hand, and place and orientation of surroundings that lean by a rotation and an angle [rad]."""


def wrist(arm: Arm, q: tuple[float, ...]) -> tuple[Vector, Quat]:
    """Position [m] and orientation of the wrist, base frame."""
    from tasks.kinematics import kinematics  # MuJoCo takes a moment to import; listing names must not

    p, quat = kinematics(arm, "wrist").pose(q)
    x, y, z = p.tolist()
    return (x, y, z), quat


def mounts(arm: Arm, q: tuple[float, ...], goal: Quat) -> Quat:
    """Return the hand's frame in the wrist's for which the hand has the orientation `goal` at the joint angles q."""
    w, x, y, z = wrist(arm, q)[1]
    return multiply((w, -x, -y, -z), goal)


def at(arm: Arm, q: tuple[float, ...], point: Vector) -> Vector:
    """Return the position [m] of a point of the wrist's frame, base frame."""
    p, quat = wrist(arm, q)
    return plus(p, to_base(quat, point))


def plus(p: Vector, v: Vector) -> Vector:
    """p + v."""
    return (p[0] + v[0], p[1] + v[1], p[2] + v[2])


def leaning(tilt_deg: float, azimuth_deg: float) -> Quat:
    """Return the frame turned by the tilt about the horizontal axis at this azimuth, from x towards y."""
    azimuth = math.radians(azimuth_deg)
    return about((math.cos(azimuth), math.sin(azimuth), 0.0), math.radians(tilt_deg))


def leaning_trials(arm: Arm, leans: Iterable[tuple[int, int]], dense: bool, stands: Stands) -> tuple[Trial, ...]:
    """Return a trial for each way in which the surroundings lean, (tilt, azimuth) [deg], and each frame of the hand.

    Those that differ in beta alone are the same mechanics: the hand's frame is R = Ry(beta) at the goal.
    """
    q, found = arm.home, []
    for (tilt, azimuth), beta in itertools.product(leans, DENSE_BETAS if dense else BETAS):
        goal = zyx(0.0, math.radians(beta), 0.0)
        specification, place, quat = stands(leaning(tilt, azimuth), math.radians(tilt))
        pose, mount = f"tilt {tilt} about {azimuth}, beta{beta:+d}", mounts(arm, q, goal)
        found.append(Trial(pose, pose, specification, q, goal, mount, place, quat, tilt=math.radians(tilt)))
    return tuple(found)
