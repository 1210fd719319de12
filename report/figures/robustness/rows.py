"""Episodes under perturbations as the pages read them, and what every page says of them."""

from __future__ import annotations

import functools

import numpy as np
import pandas as pd

import tasks
from bench.experiments.tables.statistics import quantile
from bench.findings.perturbed import went_well
from report.figures.kit import families
from report.figures.kit.page import Run


@functools.cache
def along(run: Run, name: str) -> pd.DataFrame:
    """Return rows of one perturbation, by family, with `good` and `time_s`, infinite where nothing settled."""
    rows = run.rows("robustness", axis=name)
    names = families.in_order(rows["contender"].unique())
    return rows.assign(
        contender=pd.Categorical(rows["contender"].astype(str), names, ordered=True),
        good=went_well(rows),
        time_s=rows["settling_time_s"].where(rows["outcome"] == "settled", np.inf),
    )


def laws(rows: pd.DataFrame, controls: bool = True) -> list[str]:
    """Return the laws of the rows, family by family; without the negative controls if so asked."""
    names = [name for name in rows["contender"].cat.categories if (rows["contender"] == name).any()]
    return names if controls else [name for name in names if name not in families.CONTROLS]


def of(rows: pd.DataFrame, law: str) -> pd.DataFrame:
    """Return rows of one law."""
    return rows[rows["contender"] == law]


def gains(rows: pd.DataFrame) -> tuple[float, float]:
    """(kp, kv) of the rows."""
    return float(rows["kp"].iloc[0]), float(rows["kv"].iloc[0])


def starts(rows: pd.DataFrame) -> int:
    """Return the starts of a law at a level."""
    return int(rows.groupby(["contender", "level"], observed=True).size().max())


def nominal(name: str) -> float:
    """Return the level without perturbation; of one that has none, its mildest: the largest bound."""
    axis = tasks.axis(name)
    return max(axis.levels) if axis.nominal is None else axis.nominal


def worst(rows: pd.DataFrame, name: str) -> float:
    """Return the level most levels away from the nominal one; of two such the greater."""
    there = sorted(rows["level"].unique())
    place = there.index(nominal(name))
    return there[0] if place > len(there) - 1 - place else there[-1]


def medians(rows: pd.DataFrame, column: str = "time_s") -> pd.DataFrame:
    """Median of a column: a row a level, a column a law; negative controls left out."""
    kept = rows[rows["contender"].isin(laws(rows, controls=False))].groupby(["level", "contender"], observed=True)
    return kept[column].apply(lambda values: float(quantile(values.to_numpy(), 0.5))).unstack()
