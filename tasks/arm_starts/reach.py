"""Moves of the tool to another pose in good condition: by 10 cm at least, and turned by 10 to 150 degrees.

Start and goal are drawn around home. A pair is kept if the tool can go straight from one position to the other while
it turns along the geodesic, evenly both, and all of that is clear (clearance.py). The goal's joint angles are those at
the end of the path, which need not be those that were drawn, and the goal is MuJoCo's pose of them, bit for bit.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator

import numpy as np

from tasks.arm_model import Arm
from tasks.arm_starts.clear import AROUND_HOME
from tasks.base import ArmStartSet, Vector
from tasks.clearance import CONDITION, RANGE, is_clear_of_pole, is_clear_of_wraps, steps_for
from tasks.haar import endless
from tasks.kinematics import Kinematics, kinematics, rotation_vector
from tasks.linear_algebra import length
from tasks.paths import geodesic

SIZE = 24
LEAST_WAY, LEAST_TURN, MOST_TURN = 0.1, math.radians(10.0), math.radians(150.0)  # [m], [rad]
# Points of the way at most so far apart [m]: a joint turns by some 10 degrees in between, at a condition of 10.
STEP = 0.05
TRIES = 1000  # pairs for each start at most
OTHER_SEED = 2000


def build(arm: Arm, count: int, seed: int) -> list:
    """Return the first `count` of the sequence of this seed."""
    model, starts = kinematics(arm), []
    candidates = _pairs(arm, seed + OTHER_SEED)
    for i in range(count):
        pairs = itertools.islice(candidates, TRIES)
        ends = next(((q, there) for q, aim in pairs if (there := _moved(model, q, aim)) is not None), None)
        if ends is None:
            break
        p, goal = model.pose(ends[1])
        joints = {"goal_p": tuple(p.tolist()), "goal_q": tuple(ends[1].tolist())}
        starts.append(model.start(f"reach-{i:03d}", ends[0], goal, **joints))
    return starts


def _pairs(arm: Arm, seed: int) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Two sets of joint angles around home, evenly spread together, without end."""
    home = np.array(arm.home)
    for point in endless(2 * arm.joints, seed):
        q, aim = (home + AROUND_HOME * (2.0 * half - 1.0) for half in np.split(np.array(point), 2))
        yield q, aim


def _moved(model: Kinematics, q: np.ndarray, aim: np.ndarray) -> np.ndarray | None:
    """Return the joint angles at the end of a clear path from q to the pose of aim, or None."""
    (p, quat), (p_d, quat_d) = model.pose(q), model.pose(aim)
    x, y, z = rotation_vector(quat_d, quat)
    way, angle = p_d - p, math.sqrt(x * x + y * y + z * z)
    if length(way) < LEAST_WAY or not LEAST_TURN <= angle <= MOST_TURN or not _is_clear(model, q):
        return None
    axis: Vector = (x / angle, y / angle, z / angle)
    steps = max(steps_for(angle), math.ceil(length(way) / STEP))
    turn = geodesic(quat, axis, angle, steps)
    if not (is_clear_of_pole(turn) and is_clear_of_wraps(turn)):
        return None
    for i in range(1, steps + 1):
        reached = model.reach(q, p + (i / steps) * way, turn[i])
        if reached is None or not _is_clear(model, reached):
            return None
        q = reached
    return q


def _is_clear(model: Kinematics, q: np.ndarray) -> bool:
    return model.within_range(q, RANGE) and model.condition(q) <= CONDITION


STARTS = ArmStartSet("reach", "Moves to another pose that keep clear of all that `clear` does", SIZE, build, True)
