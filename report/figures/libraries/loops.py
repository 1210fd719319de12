"""Libraries' errors and controllers in closed loop, and what the audit says of them, as the page reads it.

Read from results/libraries, which is committed: it does not change with the run that a report is built from.
"""

from __future__ import annotations

import functools

import pandas as pd

from bench.tables.store import read
from report.figures.kit import html
from report.figures.libraries.answers import FOLDER

RIGHT = "right"


@functools.cache
def verdicts() -> pd.DataFrame:
    """A row a function: convention, faults, replacement; words as words."""
    return _words(read(FOLDER, "verdicts"))


@functools.cache
def responses() -> pd.DataFrame:
    """A row a function or controller: its starts below 180° and at it.

    Columns: library, function, kind, error, command; fastest, slowest [s], over all starts below 180°; unsettled,
    away: of `starts` there; at_180, dead: of the starts at 180° exactly, how many and how many of them never move.
    """
    rows = _words(read(FOLDER, "closed_loop"))
    lines = []
    for (library, function, kind), own in rows.groupby(["library", "function", "kind"], sort=False):
        below, at = own[own["angle_deg"] < 180.0], own[own["angle_deg"] == 180.0]
        lines.append(
            {
                "library": library,
                "function": function,
                "kind": kind,
                "error": own["error"].iloc[0],
                "command": own["command"].iloc[0],
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


def settling(one) -> str:
    """Of a line: fastest to slowest [s]."""
    if pd.isna(one.fastest):
        return "never"
    ends = dict.fromkeys((f"{one.fastest:.3g}", f"{one.slowest:.3g}"))
    never = f"; never from {one.unsettled} of {one.starts}" if one.unsettled else ""
    return " to ".join(ends) + never


def dead(one) -> str:
    """Of a line: how many of the exact 180° rotations never move."""
    return "all" if one.dead == one.at_180 else str(one.dead or html.MISSING)


def away(one) -> str:
    """Of a line: how many starts turn away from the goal first."""
    return f"{one.away} of {one.starts}" if one.away else html.MISSING


def instead(one) -> str:
    """Of a controller's line: the replacement for its error, by what it takes, where the loop is not right."""
    return one.replacement or ("" if verdict(one) == RIGHT else f"of_{one.takes}")


def verdict(one) -> str:
    """Of a controller's line, in the check's words where it has them."""
    words = {"dead-at-180": one.dead, "not settled": one.unsettled, "long-way": one.away}
    return ", ".join(word for word, count in words.items() if count) or RIGHT
