"""Turns in place whose middle is a kinematic singularity, or at 10^-k from one, while the tool keeps off its pole.

`exact`: in the middle J has rank 5 (sigma_min under 1e-12, condition number over 1e12), and the turn is about an axis
that passes: joint rates stay finite, in the limit, though J^-1 does not. `k2` to `k6`: in the middle sigma_min, the
distance of J from the nearest singular matrix, is 10^-k, so that the condition number is about 2 times 10^k. The turn
is then about the axis that is all but lost there, which takes joint rates of up to 10^k times the tool's; or, where
the arm's workspace ends at the singularity and it can go no further that way (the Jaco's wrist, with its bent axes),
about an axis across the lost one, along the end. Start and goal are HALF_ANGLE before and after the middle, where the
condition number is at most CONDITION; all along, joints are RANGE inside their ranges and |cos beta| is at least
COS_BETA (clearance.py). With seven joints all this is so of one joint path; others lead around the singularity.

Singularities are searched from around home (singular.py). What a wrist's singularity takes away is mostly a rotation,
what an elbow's takes away a translation: of every SEARCHED those come first whose lost twist u has the largest
rotational part, metres against radians, and the first POSES are taken for which all of these turns can be made. On a
PUMA and a UR5e these have q5 = 0 or pi.

Limitations: an arm with fewer such singularities around home has fewer starts.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator

import numpy as np

from tasks.arm_model import Arm
from tasks.arm_starts.clear import around_home
from tasks.base import ArmStartSet, Quat, Start, Vector
from tasks.clearance import CONDITION, RANGE, is_clear_of_pole
from tasks.kinematics import Kinematics, kinematics
from tasks.linear_algebra import length
from tasks.paths import beyond, turned
from tasks.rotations import unit
from tasks.singular import Singularity, beside, path_from, rates_through, singularity_near, widening

HALF_ANGLE = math.radians(40.0)
# Points on a 180° rotation: a degree apart, since with seven joints the path depends on its points near a singularity.
THROUGH = 40
DECADES = range(2, 7)
POSES = 4
SIZE = POSES * (1 + len(DECADES))
SEARCHED = 40
ROUNDS = 5
# A condition number that rises by more above what it has fallen to comes near another singularity.
RISE = 1.5
# |u's rotational part|, of 1: less, and a turn in place hardly notices.
LEAST_ROTATION = 0.05
# Axes tried for the turn that passes, and the shortest part of one across u to be an axis at all.
AXES = 4
ACROSS = 0.1

Turn = tuple[np.ndarray, Quat]


def build(arm: Arm, count: int, seed: int) -> list[Start]:
    """Exact ones first, then every singularity at 0.01, at 0.001, ..."""
    model, words = kinematics(arm), ("exact", *(f"k{k}" for k in DECADES))
    families = [
        [model.start(f"wrist-{i}-{word}", *turn) for word, turn in zip(words, turns, strict=True)]
        for i, turns in enumerate(itertools.islice(_families(model, seed), POSES))
    ]
    return [start for level in zip(*families, strict=True) for start in level]


def _families(model: Kinematics, seed: int) -> Iterator[list[Turn]]:
    """Yield the turns of one singularity after the other, if they can all be made."""
    candidates = around_home(model.arm, seed)
    for _ in range(ROUNDS):
        found = [singularity_near(model, next(candidates)[0]) for _ in range(SEARCHED)]
        within = [at for at in found if at and model.within_range(at.q, RANGE) and _rotation(at) >= LEAST_ROTATION]
        for at in sorted(within, key=_rotation, reverse=True):
            turns = _family(model, at, [next(candidates)[1] for _ in range(AXES)])
            if turns:
                yield turns


def _rotation(at: Singularity) -> float:
    return length(at.u[3:])


def _family(model: Kinematics, at: Singularity, drawn: list[Vector]) -> list[Turn] | None:
    """Return the turn through the singularity, then those past it at every distance; None if any cannot be made."""
    turns = [next(filter(None, (_through(model, at, axis) for axis in _across(at.u[3:], drawn))), None)]
    for k in DECADES:
        if turns[-1]:
            turns.append(_past(model, at, 10.0**-k, drawn))
    return [turn for turn in turns if turn] if turns[-1] else None


def _across(lost: np.ndarray | Vector, drawn: list[Vector]) -> Iterator[Vector]:
    """Yield what is left of the drawn axes across the lost one, of unit length."""
    along = unit((lost[0], lost[1], lost[2]))
    for axis in drawn:
        share = along[0] * axis[0] + along[1] * axis[1] + along[2] * axis[2]
        x, y, z = (a - share * b for a, b in zip(axis, along, strict=True))
        if math.hypot(x, y, z) > ACROSS:
            yield unit((x, y, z))


def _through(model: Kinematics, at: Singularity, axis: Vector) -> Turn | None:
    out = [HALF_ANGLE * i / THROUGH for i in range(1, THROUGH + 1)]
    for rates in rates_through(model, at, axis):
        paths = [path_from(model, at, axis, rates, [sign * x for x in out]) for sign in (-1.0, 1.0)]
        turn = _turn(model, at.q, axis, paths)
        if turn:
            return turn
    return None


def _past(model: Kinematics, at: Singularity, distance: float, drawn: list[Vector]) -> Turn | None:
    found = beside(model, at, distance)
    if found is None:
        return None
    q, lost = found
    middle, out = model.pose(q)[1], widening(distance, HALF_ANGLE, HALF_ANGLE / THROUGH)
    for axis in (lost, *_across(lost, drawn)):
        paths = (model.follow(q, [turned(middle, axis, sign * x) for x in out]) for sign in (-1.0, 1.0))
        turn = _turn(model, q, axis, paths)
        if turn:
            return turn
    return None


def _turn(model: Kinematics, q: np.ndarray, axis: Vector, paths: Iterable[np.ndarray | None]) -> Turn | None:
    """Return (start's q, goal) of the turn with the pose of q in its middle; the two paths lead away from there."""
    middle = model.pose(q)[1]
    if not is_clear_of_pole(turned(middle, axis, HALF_ANGLE * i / 8.0) for i in range(-8, 9)):
        return None
    ends = []
    for path in paths:
        if path is None or not all(model.within_range(now, RANGE) for now in path):
            return None
        conditions = [model.condition(now) for now in path]
        # it falls towards the end, so that the middle's singularity is the only one on the way
        least = itertools.accumulate(conditions, min)
        if any(now > max(CONDITION, RISE * before) for now, before in zip(conditions, least, strict=True)):
            return None
        if conditions[-1] > CONDITION:
            return None
        ends.append(path[-1])
    return ends[0], beyond(model.pose(ends[0])[1], middle)


STARTS = ArmStartSet("wrist", "Turns through and past kinematic singularities, the tool off its pole", SIZE, build)
