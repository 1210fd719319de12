"""Show where each law fails exactly: 180° rotations, poles and jumps of coordinates, which uniform starts never hit."""

from __future__ import annotations

import pandas as pd

from bench.experiments.tables.read import converged
from bench.findings.start_sets import AT_REST
from report.figures.comparison.cells import by_family
from report.figures.failures.failure_map import once, places
from report.figures.kit import families, html

EXACT = ("180° rotation", "180° rotation and pole", "pole", "jump of atan2")
"""Of `failure_map.places`, those that are points and no neighbourhoods."""

ELSEWHERE = "beside them"


def directed(episodes: pd.DataFrame) -> pd.DataFrame:
    """Directed starts at rest, with the special place of each, and each orientation once; rows of one engine."""
    rows = episodes[episodes["start_set"].isin(AT_REST) & (episodes["arm"] == "")]
    place = places(rows)
    rows = rows.assign(place=place.where(place.isin(EXACT), ELSEWHERE))
    return once(rows)


def table(rows: pd.DataFrame) -> html.Markdown | None:
    """A row a law, a column a place: how many of the starts there fail, and how; a dash where none was tried."""
    shown = [place for place in (*EXACT, ELSEWHERE) if (rows["place"] == place).any()]

    def line(name: str) -> dict:
        own = rows[rows["contender"] == name]
        return {place.capitalize(): failing(own[own["place"] == place]) for place in shown}

    return by_family(rows["contender"].unique(), line)


def failing(rows: pd.DataFrame) -> str:
    """ "26 of 26 stuck": how many do not settle, and what most of them do instead; those that do not converge apart."""
    if rows.empty:
        return html.MISSING
    sure = converged(rows)
    apart = f", {len(rows) - len(sure)} not converged" if len(sure) < len(rows) else ""
    failed = sure.loc[sure["outcome"] != "settled", "outcome"].astype(str)
    if failed.empty:
        return f"none of {len(sure)}{apart}"
    return f"{len(failed)} of {len(sure)} {failed.value_counts().index[0]}{apart}"


def left(rows: pd.DataFrame) -> list[str]:
    """The laws that leave every directed start, family by family."""
    failed = set(rows.loc[rows["outcome"] != "settled", "contender"])
    return [name for name in families.in_order(rows["contender"].unique()) if name not in failed]
