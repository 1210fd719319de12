"""Libraries' errors and controllers in closed loop, and what the audit says of them, as the page reads it."""

import functools

import pandas as pd

from report.figures.libraries import answers

verdicts, rows = (functools.partial(answers.table, name) for name in ("verdicts", "closed_loop"))
"""Rows of a function: convention, faults, replacement; and how it ends from each angle."""


@functools.cache
def responses() -> pd.DataFrame:
    """Return a row a function or controller: its starts below 180° and at it.

    Columns: library, function, kind; unsettled, away: of the starts below 180°; at_180, dead: of the starts at 180°,
    how many and how many of them never move.
    """
    is_at = rows()["angle_deg"] == 180.0
    below, at = (rows()[chosen].groupby(["library", "function", "kind"], sort=False) for chosen in (~is_at, is_at))
    counts = {
        "unsettled": below[["dead", "lost", "failed"]].sum().sum(axis=1),
        "away": below["away"].sum(),
        "at_180": at["starts"].sum(),
        "dead": at["dead"].sum(),
    }
    return pd.DataFrame(counts).reset_index()
