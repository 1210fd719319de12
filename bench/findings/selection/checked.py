"""How often the advice held in the situations of the study `bench.studies.advice_check`."""

from pathlib import Path
from typing import NamedTuple

import pandas as pd

from bench.experiments.tables.schema import RESULTS
from bench.experiments.tables.store import read_arrow

OUT = Path("advice-check") / "advice_check.parquet"
"""The study's table, in the folder of results."""

WITHIN, EXACT = 0.01, 0.05
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
