"""Joint angles spread evenly over the joint ranges, goals spread evenly over SO(3), at rest.

Nothing keeps clear of anything: fractions are of what an arm can be asked, not of what it does well. A joint's range is
the file's, or one turn about its middle if it is wider or there is none. A goal is kept if the search finds joint
angles, in range, at which the tool has the goal's orientation at the start's position, from the start's own joints,
from home, or from SEEDS more. A goal that no search found may still be reachable.
"""

from __future__ import annotations

import itertools
import math

import numpy as np

from tasks.arm_model import Arm
from tasks.base import ArmStartSet, Quat, Start
from tasks.haar import endless, halton, orientation
from tasks.kinematics import Kinematics, kinematics

SIZE = 200
SEEDS = 6
SEED_OF_SEEDS = 1988
# Candidates a start at most; an arm that reaches one goal in so many is no arm to turn a tool with.
MOST_TRIES = 62


def build(arm: Arm, count: int, seed: int) -> list[Start]:
    """Return the first `count` candidates whose goal is reachable."""
    model, n = kinematics(arm), arm.joints
    seeds = [spread(arm, point) for point in halton(SEEDS, n, SEED_OF_SEEDS)]
    starts: list[Start] = []
    for point in itertools.islice(endless(n + 3, seed), MOST_TRIES * count):
        q, goal = spread(arm, point[:n]), orientation(*point[n:])
        there = _reached(model, q, goal, [q, np.array(arm.home), *seeds])
        if there:
            starts.append(model.start(f"uniform-{len(starts):04d}", q, goal, goal_q=there))
        if len(starts) == count:
            break
    return starts


def spread(arm: Arm, point: list[float]) -> np.ndarray:
    """Return the joint angles of a point of the unit cube."""
    q = []
    for u, low, high in zip(point, arm.lower, arm.upper, strict=True):
        middle = 0.5 * (low + high) if high - low < math.inf else 0.0
        q.append(middle + (u - 0.5) * min(high - low, math.tau))
    return np.array(q)


def _reached(model: Kinematics, q: np.ndarray, goal: Quat, seeds: list[np.ndarray]) -> tuple[float, ...]:
    """Return the joint angles of the goal, in range, by the first guess that leads to some; empty if none does."""
    p, _ = model.pose(q)
    found = (model.find(guess, p, goal) for guess in seeds)
    ends = (model.into_range(there) for there in found if there is not None)
    return next((tuple(there.tolist()) for there in ends if model.within_range(there)), ())


STARTS = ArmStartSet("uniform", "Joint angles and goals spread evenly, if the goal can be reached", SIZE, build, True)
