"""Tasks in contact: how many trials of each controller are done, and how well the hand complies."""

import math
from collections.abc import Iterator

import pandas as pd

from bench.cli.details.episodes import tabulate

COLUMNS = {
    "leakage_ratio": ("leakage", 1.0),
    "misalignment_rad": ("misaligned deg", 180.0 / math.pi),
    "alignment_error_rad": ("off the plate deg", 180.0 / math.pi),
}
"""Columns of compliance.parquet that are summarized: as what, in which unit."""


def tables(rows: pd.DataFrame) -> Iterator[tuple[str, pd.DataFrame]]:
    """Yield a table for each arm."""
    for arm, part in rows.groupby("arm", observed=True, sort=False):
        title = f"{arm}, contact (a/b: a of b poses done; then median and worst of these)"
        yield title, tabulate(part, describe)


def describe(rows: pd.DataFrame) -> dict[str, str]:
    """Return how many poses are done, how many of those with an end are at rest, and median and worst of COLUMNS."""
    done = rows[rows["outcome"] == "done"]
    line = {"done": f"{len(done)}/{len(rows)}"}
    if "rest" in done:  # not in a run of before there was an end
        ends = done["rest"].astype(str)
        line["at rest"] = f"{(ends == 'at-rest').sum()}/{(ends != '').sum()}"
    for column, (title, scale) in COLUMNS.items():
        some = scale * done[column].dropna()
        line[title] = f"{some.median():.3f}  {some.max():.3f}" if len(some) else ""
    return line
