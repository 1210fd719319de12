"""A goal that jumps while the body moves: base frame first, the start's goal from the level's time on, memory kept.

The goal that holds is drawn evenly and differs per start. Until the jump nothing is judged. Settling, path, overshoot
and all other measures are of the goal that holds and counted from the jump; the band and the ratio of the path are of
the angle to that goal at the jump. The goal stands still before and after; with `reference_amplitude` as in moving_goal
both goals sway.
"""

from __future__ import annotations

from tasks.axis import Axis, Field
from tasks.base import Start
from tasks.haar import halton, orientation


def starts(count: int, seed: int, level: float) -> list[Start]:
    """Orientations at rest and goals, pairs spread evenly over SO(3) x SO(3): the same at every level."""
    pairs = enumerate(halton(count, 6, seed))
    return [Start(f"jump-{i:04d}", orientation(*point[:3]), goal_wxyz=orientation(*point[3:])) for i, point in pairs]


AXIS = Axis(
    "goal-jump",
    "Goal that jumps, memory kept",
    "s",
    (0.0, 0.05, 0.1, 0.2, 0.5, 1.0),
    0.0,
    (
        Field(
            "jump_s",
            0.0,
            "time at which the goal leaves the base frame for the start's goal [s]",
            in_loop=True,
            lasts=False,
        ),
        Field(
            "jump_resets",
            0,
            "1: the law's memory is then what it is at first",
            in_loop=True,
            lasts=False,
        ),
    ),
    starts=starts,
)
