"""How a hand's frame is drawn on the hand, and where trials of contact tasks begin."""

from __future__ import annotations

import functools

from tasks.arm import Arm
from tasks.base import Quat
from tasks.kinematics import Kinematics
from tasks.rotations import multiply


def posture(arm: Arm) -> tuple[float, ...]:
    """Joint angles at which trials begin: home, where our arms point the wrist down and are well conditioned."""
    return arm.home


def wrist(arm: Arm, q: tuple[float, ...]) -> tuple[tuple[float, float, float], Quat]:
    """Position [m] and orientation of the wrist, base frame."""
    p, quat = _kinematics(arm).pose(q)
    x, y, z = p.tolist()
    return (x, y, z), quat


def mounts(arm: Arm, q: tuple[float, ...], goal: Quat) -> Quat:
    """The hand's frame as the wrist sees it, if it shall have the orientation `goal` at the joint angles q."""
    w, x, y, z = wrist(arm, q)[1]
    return multiply((w, -x, -y, -z), goal)


@functools.cache
def _kinematics(arm: Arm) -> Kinematics:
    return Kinematics(arm, "wrist")
