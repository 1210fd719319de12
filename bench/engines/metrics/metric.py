"""What a metric is: a number folded over the ticks of an episode, compiled with the loop and never stored per tick.

CONTRIBUTING.md shows the whole file of a metric.
"""

import math
from collections.abc import Callable
from typing import NamedTuple


class Ending(NamedTuple):
    """What is known of an episode when its metrics are finished. Angles in radians."""

    angle0: float
    final_angle: float
    band: float
    outcome: str


class Metric(NamedTuple):
    """One column of the results, by which it is called.

    start: the number before the first tick. update(value, sample) -> value, in the law dialect; `sample` is an
    `engines.episode.Sample`. finish(value, ending) -> the column, plain Python.
    arm_only: whether it needs an `engines.arm_episode.ArmSample`; empty on the free body.
    """

    column: str
    unit: str
    title: str
    start: float
    update: Callable
    finish: Callable
    arm_only: bool = False


def as_it_is(value, ending):
    """Return the number itself."""
    return value


def if_finite(value, ending):
    """Return the number itself; none where it is infinite: nothing was seen, or it was lost."""
    return value if value < math.inf else math.nan


def root(value, ending):
    """Return the square root of the largest square."""
    return math.sqrt(value)
