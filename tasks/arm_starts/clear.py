"""Turns of 10 to 150 degrees that nothing of the arm stands in the way of: failures here are the law's own.

Joint angles are spread around home, axes over the sphere. A candidate is kept if the tool can be turned in place both
along the geodesic and along the straight line in Z-Y-X angles, the paths of all laws here but for their transients,
and both are clear (clearance.py; a straight line between principal values crosses no jump).

Angles are stratified, from a van der Corput sequence. An angle for which TRIES candidates in turn are refused is
shortened by a fifth, until there is one: an arm that cannot turn far has small turns in place of large ones.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from tasks.arm_model import Arm
from tasks.base import ArmStartSet, Quat, Start, Vector
from tasks.clearance import CONDITION, RANGE, clear_path, is_clear_of_pole, is_clear_of_wraps, steps_for
from tasks.haar import direction, endless
from tasks.kinematics import Kinematics, kinematics
from tasks.paths import geodesic, straight_zyx

SIZE = 32
SMALLEST, LARGEST = 10.0, 150.0  # [degrees], so that the names of the strata are exact
# Half width of the joint angles around home [rad]. Within 1 rad nearly all poses are well conditioned; within 0.5 rad
# an arm whose tool points down at home, on the jump of gamma, has few that are clear of it.
AROUND_HOME = 1.0
TRIES = 150
SHORTER = 0.8
SHORTENINGS = 30  # at most: the fifth of a degree that is left of 150 degrees then is no turn to test with


def build(arm: Arm, count: int, seed: int) -> list[Start]:
    """Return the first `count` of the sequence of this seed."""
    model = kinematics(arm)
    turns = enumerate(clear_turns(model, count, seed))
    return [model.start(f"clear-{i:03d}-{degrees:03.0f}-degrees", q, goal) for i, (q, goal, degrees) in turns]


def clear_turns(model: Kinematics, count: int, seed: int) -> Iterator[tuple[np.ndarray, Quat, float]]:
    """(q, goal, angle in degrees) of clear turns, `count` of them at most, their angles stratified."""
    candidates = around_home(model.arm, seed)
    for i in range(count):
        degrees = SMALLEST + (LARGEST - SMALLEST) * van_der_corput(i + 1)
        for _ in range(SHORTENINGS):
            tries = (_turn(model, *next(candidates), math.radians(degrees)) for _ in range(TRIES))
            found = next(filter(None, tries), None)
            if found:
                yield *found, degrees
                break
            degrees *= SHORTER
        else:
            return


def _turn(model: Kinematics, q: np.ndarray, axis: Vector, angle: float) -> tuple[np.ndarray, Quat] | None:
    """(q, goal) of a turn if it is clear; what costs least is looked at first."""
    if not model.within_range(q, RANGE) or model.condition(q) > CONDITION:
        return None
    steps = steps_for(angle)
    turn = geodesic(model.pose(q)[1], axis, angle, steps)
    if not (is_clear_of_pole(turn) and is_clear_of_wraps(turn)):
        return None
    line = straight_zyx(turn[0], turn[-1], steps)
    if not is_clear_of_pole(line) or clear_path(model, q, turn) is None or clear_path(model, q, line) is None:
        return None
    return q, turn[-1]


def around_home(arm: Arm, seed: int, width: float = AROUND_HOME) -> Iterator[tuple[np.ndarray, Vector]]:
    """Joint angles within `width` [rad] of home and an axis, evenly spread, without end."""
    n, home = arm.joints, np.array(arm.home)
    for point in endless(n + 2, seed):
        yield home + width * (2.0 * np.array(point[:n]) - 1.0), direction(*point[n:])


def van_der_corput(i: int) -> float:
    """Return the i-th number of 0, 1/2, 1/4, 3/4, 1/8, ...: i's binary digits mirrored at the point."""
    x, scale = 0.0, 0.5
    while i:
        x += scale * (i & 1)
        i >>= 1
        scale *= 0.5
    return x


STARTS = ArmStartSet("clear", "Turns in place that keep clear of singularities, poles, jumps and ranges", SIZE, build)
