"""Goals far from the identity: can a regulator drive to anything but zero (Murphy 1988, section 2.4)?

Directed pairs come first, then pairs drawn uniformly from SO(3) x SO(3), those kept whose goal is more than a quarter
turn from the identity (82 % of them).
"""

from __future__ import annotations

import bisect
import functools
import math
import threading

from tasks.base import IDENTITY, Quat, Start, StartSet, haversine
from tasks.haar import halton, orientation
from tasks.rotations import about, multiply, on_pole, short_of_180_degrees, zyx

FAR = 0.5  # haversine of a quarter turn
BLOCK = 512  # candidates that are looked at together
AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
SMALL_STEP = about((1.0, -2.0, 2.0), 0.1)
OFFSET = about((2.0, 1.0, -2.0), 1.0)
GENERIC_GOAL = zyx(2.0, -0.6, 1.4)


def between(first: int, end: int, seed: int) -> list[Start]:
    """Return the goals from `first` to before `end`."""
    directed = _directed()
    ahead = len(directed)
    return directed[first:end] + _uniform(max(0, first - ahead), max(0, end - ahead), seed)


def _directed() -> list[Start]:
    starts = []
    for word, sign in (("plus", 1), ("minus", -1)):
        for twist in (0.0, math.pi / 2.0, 1.0):
            goal = on_pole(sign, twist)
            name = f"goal-pole-{word}-twist-{twist:.1f}"
            starts.append(_pair(f"{name}-from-identity", IDENTITY, goal))
            starts.append(_pair(f"{name}-offset", OFFSET, goal, moved=True))
    # 0.4 rad apart the short way, which crosses +-pi; 2 pi - 0.4 the long way
    for word, sign in (("up", 1), ("down", -1)):
        near, beyond = sign * (math.pi - 0.2), -sign * (math.pi - 0.2)
        starts.append(_pair(f"goal-beyond-wrap-alpha-{word}", zyx(near, 0.3, 0.2), zyx(beyond, 0.3, 0.2)))
        starts.append(_pair(f"goal-beyond-wrap-gamma-{word}", zyx(0.2, 0.3, near), zyx(0.2, 0.3, beyond)))
    for name, axis in AXES.items():
        goal = short_of_180_degrees(axis, 0.0)
        starts.append(_pair(f"goal-half-turn-{name}-from-identity", IDENTITY, goal))
        starts.append(_pair(f"goal-half-turn-{name}-small-step", SMALL_STEP, goal, moved=True))
        starts.append(_pair(f"goal-half-turn-{name}-offset", OFFSET, goal, moved=True))
        starts.append(_pair(f"start-half-turn-{name}-from-goal", goal, GENERIC_GOAL, moved=True))
    starts.append(_pair("goal-generic-small-step", SMALL_STEP, GENERIC_GOAL, moved=True))
    starts.append(_pair("goal-generic-at-goal", GENERIC_GOAL, GENERIC_GOAL))
    return starts


def _pair(name: str, quat: Quat, goal: Quat, moved: bool = False) -> Start:
    """Return a start at `quat`, or at the goal turned by `quat` about base axes."""
    return Start(name, multiply(quat, goal) if moved else quat, goal_wxyz=goal)


def _uniform(first: int, end: int, seed: int) -> list[Start]:
    if end <= first:
        return []
    block, ahead = _block_of(first, seed)
    pairs: list[tuple[Quat, Quat]] = []
    while ahead + len(pairs) < end:
        pairs += _far(block, seed)
        block += 1
    return [_pair(f"goal-uniform-{i:04d}", *pairs[i - ahead]) for i in range(first, end)]


def _far(block: int, seed: int) -> list[tuple[Quat, Quat]]:
    """Return the pairs of a block of candidates whose goal is far."""
    points = halton(BLOCK, 6, seed, block * BLOCK)
    pairs = [(orientation(*point[:3]), orientation(*point[3:])) for point in points]
    return [(quat, goal) for quat, goal in pairs if haversine(goal, IDENTITY) > FAR]


_counting = threading.Lock()


def _block_of(place: int, seed: int) -> tuple[int, int]:
    """Return the block that holds the far pair of this number, and how many are in blocks before it."""
    with _counting:
        before = _far_before(seed)
        while before[-1] <= place:
            before.append(before[-1] + len(_far(len(before) - 1, seed)))
        block = bisect.bisect_right(before, place) - 1
        return block, before[block]


@functools.lru_cache(maxsize=4)
def _far_before(seed: int) -> list[int]:
    """How many far pairs are before each block; it grows as farther ones are asked for."""
    return [0]


STARTS = StartSet("goals", "Goals far from the identity, directed and uniform pairs", 200, between=between)
