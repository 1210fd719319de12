"""How far each law goes along a perturbation: one definition for `judge`, `show` and the book.

An episode goes well if it settles. Where the perturbation lasts after the goal is reached no body comes to rest; there
it goes well if over the last second the root mean square angle to the goal is at most FOLLOWED_RAD. A law's threshold
is the last level, from the mildest outwards, up to which at most LOST fewer of its starts go well than at the mildest;
a law that loses more than FEWEST of them there has none.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

import numpy as np

import tasks
from bench.base.on_first_use import pd
from bench.experiments.columns import CONTENDER_KEY
from bench.experiments.tables.run import with_contender
from bench.experiments.tables.schema import RESULTS
from bench.experiments.tables.statistics import quantile
from tasks.condition import condition_at

STUDY = RESULTS / "robustness"
"""What `python -P -m bench.studies.robustness` keeps: `by_level` of hundreds of starts a level."""

FOLLOWED_RAD = math.radians(3.0)
LOST, FEWEST = 0.05, 0.5

DETOUR = 1.5
"""Path over shortest path from which a start at rest counts as unwinding: halfway from 180° to 360° is
3/2, and no spring that pulls towards the goal goes so far."""

FAR_RAD = 0.5
"""Angle to a goal that jumps, up to which no path counts: the body's stop alone is a long one beside it."""

WITHSTANDS = (
    f"at most {100 * LOST:g} points fewer of its starts go well than at the mildest level, where at least "
    f"{100 * FEWEST:g} % do; + : the last level tried"
)
"""What a threshold is, in words."""


class Direction(NamedTuple):
    """A perturbation, and whether its level grows from the mildest outwards or shrinks."""

    axis: str
    grows: bool = True

    @property
    def name(self) -> str:
        """The axis, and the direction where it shrinks."""
        return self.axis if self.grows else f"{self.axis} (down)"

    def levels_outward(self, levels: Iterable[float]) -> list[float]:
        """Return the levels on this side, from the mildest."""
        nominal = tasks.axis(self.axis).nominal
        start = max(levels) if nominal is None else nominal
        return [x for x in sorted(levels, reverse=not self.grows) if (x >= start if self.grows else x <= start)]


class Threshold(NamedTuple):
    """The last level a law withstands, NaN for none; the next level tried, NaN for none, and its share of starts."""

    held: float
    broken: float
    share: float

    def __str__(self) -> str:
        return "none" if math.isnan(self.held) else f"{self.held:g}{'+' * self.withstands_all}"

    @property
    def withstands_all(self) -> bool:
        """Tell whether the law withstands every level tried: its true threshold lies beyond the grid."""
        return math.isnan(self.broken)


@functools.cache
def directions() -> tuple[Direction, ...]:
    """Return every perturbation, once for each side of its mildest level on which it has others."""
    found = []
    for name in tasks.axis_names():
        for direction in (Direction(name, grows=True), Direction(name, grows=False)):
            if len(direction.levels_outward(tasks.axis(name).levels)) > 1:
                found.append(direction)
    return tuple(found)


@functools.cache
def lasting() -> tuple[str, ...]:
    """Return the perturbations that last."""
    every = map(tasks.axis, tasks.axis_names())
    return tuple(axis.name for axis in every if condition_at(axis, max(axis.levels)).lasts)


def went_well(rows: pd.DataFrame) -> pd.Series:
    """Whether each row of robustness.parquet did."""
    follows = rows["tail_rms_rad"] <= FOLLOWED_RAD
    return follows.where(rows["axis"].isin(lasting()), rows["outcome"] == "settled").astype(bool)


def by_level(rows: pd.DataFrame) -> pd.DataFrame:
    """Return a row a perturbation, law and level: starts, how many go well, median and longest time [s], paths.

    The median counts what never settles as infinite; the longest is of those that settle. Paths are of starts more than
    FAR_RAD from the goal where the judge begins, none of a run that does not say so.
    """
    is_settled = rows["outcome"] == "settled"
    times = rows.assign(good=went_well(rows), time_s=rows["settling_time_s"].where(is_settled, np.inf))
    angle, ratio = (rows.reindex(columns=[name])[name].astype(float) for name in ("judged_rad", "path_ratio"))
    angle = angle.where(angle > FAR_RAD)
    times = times.assign(path_rad=angle * ratio, is_long=angle.notna() & (ratio > DETOUR))
    keys = ["axis", *(name for name in CONTENDER_KEY if name in rows), "level"]
    groups = times.groupby(keys, observed=True, sort=False)
    return groups.agg(
        starts=("good", "size"),
        good=("good", "sum"),
        median_s=("time_s", lambda each: float(quantile(each.to_numpy(), 0.5))),
        longest_s=("time_s", lambda each: each[np.isfinite(each)].max()),
        far=("path_rad", "count"),
        long=("is_long", "sum"),
        path_rad=("path_rad", "max"),
    ).reset_index()


def thresholds(counted: pd.DataFrame) -> dict[str, dict[Direction, Threshold]]:
    """Return each law's threshold along each direction of rows of `by_level` with `contender`."""
    found: dict[str, dict[Direction, Threshold]] = {}
    rows = counted.assign(share=counted["good"] / counted["starts"])
    for (law, axis), own in rows.groupby([rows["contender"].astype(str), rows["axis"].astype(str)], sort=False):
        shares = own.set_index("level")["share"]
        for direction in (direction for direction in directions() if direction.axis == axis):
            found.setdefault(law, {})[direction] = _threshold(shares, direction)
    return found


def _threshold(shares: pd.Series, direction: Direction) -> Threshold:
    levels, held = direction.levels_outward(shares.index), math.nan
    least = max(FEWEST, shares[levels[0]] - LOST)
    for level in levels:
        if shares[level] < least:
            return Threshold(held, level, float(shares[level]))
        held = level
    return Threshold(held, math.nan, math.nan)


@functools.cache
def studied(folder: Path = STUDY) -> pd.DataFrame:
    """Return the study's rows with `contender`."""
    from bench.experiments.tables.store import read  # imports pyarrow: listing claims must not

    return with_contender(read(folder, "perturbed"))
