"""Goals exactly half a turn away, and short of it by 10^-k rad, in good condition.

Half a turn away the rotation-matrix error vanishes (Murphy 1988, 2.12 and section 2.4). The axes are the base's x, y
and z and AXES_DRAWN drawn ones; for each the first pose around home is taken from which the arm can make the whole
180° rotation on a clear joint path (clearance.py), about the axis or against it. Joint angles are drawn from further
around home than elsewhere, since half a turn about a given axis is much to ask.

The goal is (0, axis) times the quaternion of the start, so that the judge's haversine is at least 1 - 1e-15 and its
angle math.pi. Bit for bit R is not that of 180°, as it is on the free body: rounding leaves an error (2.12) of about
1e-16, and any law drifts away from there in time.
"""

from __future__ import annotations

import math

import numpy as np

from tasks.arm_model import Arm
from tasks.arm_starts.clear import around_home
from tasks.base import ArmStartSet, Start, Vector
from tasks.clearance import clear_path, steps_for
from tasks.haar import direction, halton
from tasks.kinematics import Kinematics, kinematics
from tasks.paths import geodesic, normal
from tasks.rotations import multiply, short_of_180_degrees

AXES: dict[str, Vector] = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
AXES_DRAWN = 3
DECADES = (1, 4, 8)
SIZE = (len(AXES) + AXES_DRAWN) * (1 + len(DECADES))
AROUND_HOME = math.pi / 2.0  # [rad]
TRIES = 300  # candidates of an axis, both ways round; our arms refuse up to twelve walks for each that does


def build(arm: Arm, count: int, seed: int) -> list[Start]:
    """Return exact 180° rotations about every axis first, then those at 0.1 rad, and so on."""
    model, starts = kinematics(arm), []
    axes = AXES | {f"drawn{i}": direction(*point) for i, point in enumerate(halton(AXES_DRAWN, 2, seed))}
    found = [(name, *pose) for name, axis in axes.items() if (pose := _pose(model, axis, seed))]
    for word, delta in (("exact", 0.0), *((f"k{k}", 10.0**-k) for k in DECADES)):
        for name, q, axis in found:
            goal = normal(multiply(short_of_180_degrees(axis, delta), model.pose(q)[1]))
            starts.append(model.start(f"half-turn-{name}-{word}", q, goal))
    return starts


def _pose(model: Kinematics, axis: Vector, seed: int) -> tuple[np.ndarray, Vector] | None:
    """Return joint angles from which half a turn about the axis, or against it, is clear: (q, axis)."""
    candidates = around_home(model.arm, seed, AROUND_HOME)
    for _ in range(TRIES):
        q, _ = next(candidates)
        quat = model.pose(q)[1]
        for sign in (1.0, -1.0):
            if clear_path(model, q, geodesic(quat, axis, sign * math.pi, steps_for(math.pi))) is not None:
                return q, (sign * axis[0], sign * axis[1], sign * axis[2])
    return None


STARTS = ArmStartSet("half-turn", "Turns by exactly pi and by pi - 10^-k with the arm in good condition", SIZE, build)
