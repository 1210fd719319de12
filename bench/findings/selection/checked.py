"""How often the advice held in situations that were drawn: `bench.studies.advice_check` and `weak_motors`."""

from pathlib import Path
from typing import NamedTuple

import pandas as pd

from bench.experiments.tables.schema import RESULTS
from bench.experiments.tables.store import read_arrow

OUT = Path("advice-check") / "advice_check.parquet"
"""The study's table, in the folder of results."""

WEAK_OUT = Path("weak-motors") / "weak_motors.parquet"
"""The table of the study of weak motors, in the folder of results."""

WITHIN, EXACT = 0.05, 0.05
"""How much slower than the best law the advised one may be, and how wrong a printed time."""


class Checked(NamedTuple):
    """What the rows of the study say.

    of: situations. possible: those in which some law meets the requirements. unstable: those whose linear loop is
    unstable. within: share of the possible ones in which the advised law is within WITHIN of the best one.
    exact: share of the advised ones whose printed time is within EXACT of that from other starts. missed: possible ones
    in which no law was advised. wrong: situations in which a law was advised, and none meets the requirements.
    """

    of: int
    possible: int
    unstable: int
    within: float
    exact: float
    missed: int
    wrong: int


def read_checked(path: Path = RESULTS / OUT) -> pd.DataFrame:
    """Return the rows of the study."""
    return read_arrow(path, "advice_check").to_pandas()


def summarize_checked(rows: pd.DataFrame) -> Checked:
    """Return what the rows of the study say."""
    is_advised = rows["advised"] != "none"
    is_possible = rows["best"] != "none"
    advised, possible = rows[is_advised], rows[is_possible]
    is_within = possible["printed"] <= (1.0 + WITHIN) * possible["best_time"]
    is_exact = (advised["printed"] - advised["large"]).abs() <= EXACT * advised["large"]
    return Checked(
        of=len(rows),
        possible=len(possible),
        unstable=int((rows["radius"] >= 1.0).sum()),
        within=float(is_within.mean()),
        exact=float(is_exact.mean()),
        missed=int((is_possible & ~is_advised).sum()),
        wrong=int((is_advised & ~is_possible).sum()),
    )


NEAR_LEAST, LITTLE_DEG = 1.15, 5.0
"""A law is near the least time within this factor; and it overshoots little below this [deg]."""

BOUND_EDGES = (0.03, 0.1, 0.2, 0.5, 1.0)
"""Edges of the classes of the bound over kp [rad] in which weak motors are counted."""


class WeakMotors(NamedTuple):
    """What is counted of situations with a bound.

    Attributes:
        low: Least bound over kp [rad].
        high: Greatest bound over kp [rad].
        of: Situations.
        advised: Those in which a law is advised.
        near: Share of these within NEAR_LEAST of the least time.
        little: Share of these that overshoot by less than LITTLE_DEG.
        ratio: Median of the law's time over the least time.
        linear: Median of the linear loop's time over the least time.
    """

    low: float
    high: float
    of: int
    advised: int
    near: float
    little: float
    ratio: float
    linear: float


def read_weak_motors(path: Path = RESULTS / WEAK_OUT) -> pd.DataFrame:
    """Return the rows of the study of weak motors."""
    return read_arrow(path, "weak_motors").to_pandas()


def count_weak_motors(rows: pd.DataFrame) -> WeakMotors:
    """Count the situations of some rows."""
    advised = rows[rows["advised"] != "none"]
    ratios = advised["time"] / advised["least"]
    return WeakMotors(
        low=float(rows["bound"].min()),
        high=float(rows["bound"].max()),
        of=len(rows),
        advised=len(advised),
        near=float((ratios <= NEAR_LEAST).mean()),
        little=float((advised["overshoot"] < LITTLE_DEG).mean()),
        ratio=float(ratios.median()),
        linear=float((advised["linear"] / advised["least"]).median()),
    )


def count_by_bound(rows: pd.DataFrame) -> list[WeakMotors]:
    """Count the situations of each class of the bound, and then all of them."""
    classes = pd.cut(rows["bound"], BOUND_EDGES, include_lowest=True)
    return [*(count_weak_motors(some) for _, some in rows.groupby(classes, observed=True)), count_weak_motors(rows)]
