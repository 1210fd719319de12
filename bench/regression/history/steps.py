"""Where a series changes.

What is counted changes when it changes: any operation of any branch, and instructions beyond REPEATS, unless the
machine code is the same. Of times a step is a build such that those before it and those from it on differ: at least
BUILDS and at most WINDOW on each side, a Mann-Whitney p below P, and medians more than RATIO apart. The build with the
least p is taken first, then the stretches on both sides of it are searched in the same way.

Fails: a time that changes by less than a tenth, or in the last few builds, shows no step yet. The comparison of each
change with its base (`bench compare`) is the gate; this is the memory.
"""

from typing import NamedTuple

import numpy as np
from scipy.stats import mannwhitneyu

from bench.regression.history.series import FLOPS, INSTRUCTIONS, Point, Series

REPEATS = 1e-3
"""Relative change of instructions a tick below which it is no news: callgrind repeats to some parts in a million."""

BUILDS, WINDOW = 5, 10
"""Builds on each side of a step in time: with fewer on one side, no order of them has a p below P, however many are on
the other; with more, an older step of the other direction would hide one."""

OTHER_COMPILER = ", with another compiler or processor"

P, RATIO = 0.001, 1.10
"""The second keeps chance out too: of thousands of builds some have a p below P, and then medians that are alike."""


class Step(NamedTuple):
    """A build from which on a series is another: from `was` to `now`, in words too."""

    series: Series
    at: int
    was: float
    now: float
    says: str

    @property
    def point(self) -> Point:
        """The build that made it."""
        return self.series.points[self.at]

    @property
    def ratio(self) -> float:
        """How many times as much."""
        return self.now / self.was if self.was else float("inf")


def steps(one: Series) -> list[Step]:
    """The steps of a series, oldest first."""
    if one.measure in (FLOPS, INSTRUCTIONS):
        return [step for at in range(1, len(one.points)) if (step := _counted(one, at))]
    values = np.array([point.value for point in one.points])
    return [_timed(one, found) for found in _splits(values, 0, len(values))]


def _counted(one: Series, at: int) -> Step | None:
    """The step at a build, if it counts otherwise than the one before."""
    before, here = one.points[at - 1 : at + 1]
    if one.measure == FLOPS:
        was, now = ({(branch, name): n for branch, name, n in point.tally} for point in (before, here))
        pairs = {key: (was.get(key, 0), now.get(key, 0)) for key in sorted({**was, **now})}
        words = [f"{' '.join(key)} {old} to {new}" for key, (old, new) in pairs.items() if old != new]
        return Step(one, at, before.value, here.value, ", ".join(words)) if words else None
    is_same_code = here.code == before.code != ""
    if is_same_code or abs(here.value / before.value - 1.0) <= REPEATS:
        return None
    reason = "" if here.compiler == before.compiler else OTHER_COMPILER
    return Step(one, at, before.value, here.value, f"{before.value:.1f} to {here.value:.1f} a tick{reason}")


class _Split(NamedTuple):
    """A build that parts the `before` from the `after`, the nearest builds on each side of it."""

    at: int
    before: np.ndarray
    after: np.ndarray

    @property
    def p(self) -> float:
        """Two-sided, of Mann and Whitney: that both are of one distribution."""
        return float(mannwhitneyu(self.before, self.after, method="exact").pvalue)

    @property
    def apart(self) -> float:
        """The larger of the two medians over the smaller."""
        was, now = np.median(self.before), np.median(self.after)
        return float(max(was, now) / min(was, now))


def _splits(values: np.ndarray, first: int, last: int) -> list[_Split]:
    """The steps in values[first:last], in their order."""
    tried = [
        _Split(at, values[max(first, at - WINDOW) : at], values[at : min(last, at + WINDOW)])
        for at in range(first + BUILDS, last - BUILDS + 1)
    ]
    if not tried:
        return []
    best = min(tried, key=lambda one: (one.p, -one.apart))
    if best.p >= P or best.apart <= RATIO:
        return []
    return [*_splits(values, first, best.at), best, *_splits(values, best.at, last)]


def _timed(one: Series, found: _Split) -> Step:
    was, now = float(np.median(found.before)), float(np.median(found.after))
    size = f"{len(found.before)} builds before, {len(found.after)} from it on"
    return Step(one, found.at, was, now, f"{now / was:.2f} times the time, p = {found.p:.1g}, {size}")
