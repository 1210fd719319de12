"""Which episodes under a perturbation went well: one criterion for the summary, its tables and the book.

It went well if it settled. Where the perturbation lasts after the goal is reached no body comes to rest; there it went
well if over the last second the root mean square angle to the goal is at most FOLLOWED_RAD.
"""

import functools
import math
from pathlib import Path

import numpy as np
import pandas as pd

import tasks
from bench.tables.read import with_contender
from bench.tables.schema import CONTENDER, RESULTS
from bench.tables.statistics import quantile
from bench.tables.store import read

STUDY = RESULTS / "robustness"
"""What `make robustness-study` keeps: `by_level` of hundreds of starts a level."""

FOLLOWED_RAD = math.radians(3.0)


@functools.cache
def perturbations() -> tuple[str, ...]:
    """Axes that perturb; one that sets the gains alone, so that peak commands are equal, does not."""
    return tuple(name for name in tasks.axis_names() if not tasks.axis(name).at(1.0).peak)


@functools.cache
def lasting() -> tuple[str, ...]:
    """Perturbations that last."""
    every = map(tasks.axis, tasks.axis_names())
    return tuple(axis.name for axis in every if axis.at(max(axis.levels)).lasts)


def went_well(rows: pd.DataFrame) -> pd.Series:
    """Whether each row of robustness.parquet did."""
    follows = rows["tail_rms_rad"] <= FOLLOWED_RAD
    return follows.where(rows["axis"].isin(lasting()), rows["outcome"] == "settled").astype(bool)


def by_level(rows: pd.DataFrame) -> pd.DataFrame:
    """A row a perturbation, law and level of robustness.parquet: starts, how many go well, median and longest time [s].

    The median counts what never settles as infinite; the longest is of those that settle.
    """
    is_settled = rows["outcome"] == "settled"
    times = rows.assign(good=went_well(rows), time_s=rows["settling_time_s"].where(is_settled, np.inf))
    keys = ["axis", *(name for name in CONTENDER if name in rows), "level"]
    groups = times.groupby(keys, observed=True, sort=False)
    return pd.DataFrame(
        {
            "starts": groups.size(),
            "good": groups["good"].sum(),
            "median_s": groups["time_s"].agg(lambda each: float(quantile(each.to_numpy(), 0.5))),
            "longest_s": groups["time_s"].agg(lambda each: each[np.isfinite(each)].max()),
        }
    ).reset_index()


@functools.cache
def studied(folder: Path = STUDY) -> pd.DataFrame:
    """The study's rows with `contender`."""
    return with_contender(read(folder, "perturbed"))
