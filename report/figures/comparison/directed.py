"""Directed starts: 180° rotations, poles and jumps of coordinates, which uniform starts never hit, and beside them."""

from __future__ import annotations

import pandas as pd

from bench.experiments.tables.read import converged
from bench.findings.start_sets import AT_REST
from report.figures.failures.failure_map import once, places
from report.figures.kit import families


def directed(episodes: pd.DataFrame) -> pd.DataFrame:
    """Directed starts at rest, with the special place of each, and each orientation once; rows of one engine."""
    rows = episodes[episodes["start_set"].isin(AT_REST) & (episodes["arm"] == "")]
    return once(rows.assign(place=places(rows)))


def count_lost(rows: pd.DataFrame) -> str:
    """Return how many of a law's starts that converge do not settle: 26 of 726."""
    sure = converged(rows)
    return f"{int((sure['outcome'] != 'settled').sum())} of {len(sure)}"


def left(rows: pd.DataFrame) -> list[str]:
    """Return the laws that leave every directed start, family by family."""
    failed = set(rows.loc[rows["outcome"] != "settled", "contender"])
    return [name for name in families.in_order(rows["contender"].unique()) if name not in failed]
