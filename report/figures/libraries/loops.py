"""Libraries' errors and controllers in closed loop, and what the audit says of them, as the page reads it.

Read from results/libraries, which is committed: it does not change with the run that a report is built from.
"""

import functools

import pandas as pd

from bench.experiments.tables.store import read
from report.figures.libraries.answers import FOLDER

RIGHT = "right"


@functools.cache
def verdicts() -> pd.DataFrame:
    """Return a row a function: convention, faults, replacement; words as words."""
    return _words(read(FOLDER, "verdicts"))


@functools.cache
def rows() -> pd.DataFrame:
    """Every row of closed_loop.parquet, words as words."""
    return _words(read(FOLDER, "closed_loop"))


@functools.cache
def responses() -> pd.DataFrame:
    """Return a row a function or controller: its starts below 180° and at it.

    Columns: library, function, kind, title, error, command; fastest, slowest [s], over all starts below 180°; slope,
    the stiffness felt over the one set; unsettled, away: of `starts` there; at_180, dead: of the starts at 180°, how
    many and how many of them never move.
    """
    lines = []
    for (library, function, kind), own in rows().groupby(["library", "function", "kind"], sort=False):
        below, at = own[own["angle_deg"] < 180.0], own[own["angle_deg"] == 180.0]
        lines.append(
            {
                "library": library,
                "function": function,
                "kind": kind,
                **own.iloc[0][["title", "error", "command"]],
                "slope": own["stiffness_ratio"].iloc[0],
                "fastest": below["fastest_s"].min(),
                "slowest": own["slowest_s"].max(),
                "starts": below["starts"].sum(),
                "unsettled": below[["dead", "lost", "failed"]].sum().sum(),
                "away": below["away"].sum(),
                "at_180": at["starts"].sum(),
                "dead": at["dead"].sum(),
            }
        )
    return pd.DataFrame(lines)


def _words(table: pd.DataFrame) -> pd.DataFrame:
    return table.astype(dict.fromkeys(table.select_dtypes("category"), str))
