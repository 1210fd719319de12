"""Tell whether a path is clear of what start sets keep clear of.

A joint path is clear if along all of it J is well conditioned and every joint stays inside its range; an orientation
path is clear if along all of it the Z-Y-X angles stay away from their pole and from the jumps of atan2.

Points of a path lie STEP apart, and the bounds are looked at on the points alone: between two of them a condition
number can be a few per cent larger.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np

from tasks.base import Quat, Vector
from tasks.kinematics import Joints, Kinematics
from tasks.paths import beyond, cos_beta, geodesic, zyx_angles

# Largest condition number of J, in metres and radians. Arms have about 10 at home; at 50 the joints turn at most
# some 25 times as fast as the tool, 1/sigma_min with sigma_max about 2.
CONDITION = 50.0
# Every joint stays so far [rad] inside its range: a critically damped response does not overshoot, and sampling, the
# integrator and the other laws' detours move a joint by less.
RANGE = 0.1
# |cos beta|: 11.5 degrees from the pole, where Edot = B^-1 omega is up to 5 times as fast as the tool turns.
COS_BETA = 0.2
# alpha and gamma stay so far [rad] from +-pi, beyond any overshoot of a response that is nearly linear.
WRAP = 0.2
STEP = math.radians(5.0)


def steps_for(angle: float) -> int:
    """Into how many parts a turn by this angle [rad] is cut."""
    return max(4, math.ceil(abs(angle) / STEP))


def is_clear_of_pole(quats: Iterable[Quat], bound: float = COS_BETA) -> bool:
    """Whether |cos beta| stays above a bound."""
    return all(cos_beta(quat) >= bound for quat in quats)


def is_clear_of_wraps(quats: Iterable[Quat]) -> bool:
    """Whether alpha and gamma stay away from +-pi."""
    for quat in quats:
        alpha, _, gamma = zyx_angles(quat)
        if max(abs(alpha), abs(gamma)) > math.pi - WRAP:
            return False
    return True


def clear_path(model: Kinematics, q: Joints, quats: Sequence[Quat]) -> np.ndarray | None:
    """Return the joint path through these orientations in place, None if it ends early or any of it is not clear."""
    path = []
    for now in model.walk(q, quats):
        if not model.within_range(now, RANGE) or model.condition(now) > CONDITION:
            return None
        path.append(now)
    return np.array(path) if len(path) == len(quats) else None


def clear_turn_through(
    model: Kinematics, q: np.ndarray, middle: Quat, axis: Vector, half: float
) -> tuple[np.ndarray, Quat] | None:
    """(q, goal) of a turn in place by 2 half [rad] whose middle is `middle`, near q's pose; None if it is not clear.

    The goal is made from the start's own quaternion, so that the middle of the geodesic is right to rounding.
    """
    there = model.reach(q, model.pose(q)[0], middle)
    if there is None:
        return None
    before, after = (
        clear_path(model, there, geodesic(middle, axis, angle, steps_for(half))) for angle in (-half, half)
    )
    if before is None or after is None:
        return None
    return before[-1], beyond(model.pose(before[-1])[1], middle)
