"""Which episodes under a perturbation went well: one criterion for the summary, its tables and the book.

It went well if it settled. Where the perturbation lasts after the goal is reached no body comes to rest; there it went
well if over the last second the root mean square angle to the goal is at most FOLLOWED_RAD.
"""

import functools
import math

import pandas as pd

import tasks

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
