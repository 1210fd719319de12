"""Episodes under perturbations as the pages read them, and what every page says of them."""

import functools

import numpy as np
import pandas as pd

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


def gains(rows: pd.DataFrame) -> tuple[float, float]:
    """(kp, kv) of the rows."""
    return float(rows["kp"].iloc[0]), float(rows["kv"].iloc[0])


def starts(rows: pd.DataFrame) -> int:
    """Return the starts of a law at a level."""
    return int(rows.groupby(["contender", "level"], observed=True).size().max())
