"""What differs between two runs: one row or column, and how a list of them is said."""

from collections.abc import Iterable, Sequence
from itertools import groupby
from typing import NamedTuple

import numpy as np
import pandas as pd

MISSING, NEW, TWICE, COLUMN, CHANGED = "missing", "new", "twice", "column", "changed"

SHOWN = 10
"""Lines of one kind."""


class Difference(NamedTuple):
    """One thing that differs.

    column: what of the row, or of the table; empty for a whole row. says: all of it in words. row: the words that name
    the row, by column; empty if it is the table that differs. was, now: in base and head.
    """

    table: str
    kind: str
    column: str
    says: str
    row: dict[str, str]
    was: str = ""
    now: str = ""


def lines(differences: Iterable[Difference]) -> list[str]:
    """What differs in lines, SHOWN of a kind and then how many more."""
    said = []
    for (table, kind, column), group in groupby(differences, lambda one: (one.table, one.kind, one.column)):
        same = [one.says for one in group]
        said += same if kind == COLUMN else same[:SHOWN]
        if kind != COLUMN and len(same) > SHOWN:
            said.append(f"{column or f'{table}: row is {kind}'}: ... and {len(same) - SHOWN} more")
    return said


def aligned(
    table: str, old: pd.DataFrame, new: pd.DataFrame, key: Sequence[str]
) -> tuple[pd.DataFrame, pd.DataFrame, list[Difference]]:
    """The rows that both have, in one order and named by their key, and what only one has."""
    old, new = (_keyed(frame, key) for frame in (old, new))
    found = []
    for name, frame in (("base", old), ("head", new)):
        twice = frame[frame.index.duplicated()]
        found += _rows(table, TWICE, f"row twice in the {name}", twice, key)
    if found:
        return old.iloc[:0], new.iloc[:0], found
    found += _rows(table, MISSING, "row is missing", old[~old.index.isin(new.index)], key)
    found += _rows(table, NEW, "row is new", new[~new.index.isin(old.index)], key)
    both = old.index.intersection(new.index, sort=False)
    return old.loc[both], new.loc[both], found


def _keyed(frame: pd.DataFrame, key: Sequence[str]) -> pd.DataFrame:
    rows = frame[list(key)].astype(str).itertuples(index=False)
    return frame.set_axis(pd.Index([" ".join(filter(None, row)) for row in rows], dtype=str), axis=0)


def _rows(table: str, kind: str, words: str, frame: pd.DataFrame, key: Sequence[str]) -> list[Difference]:
    named = zip(frame.index, _words(frame, key), strict=True)
    return [Difference(table, kind, "", f"{table}: {words}: {name}", row) for name, row in named]


def _words(frame: pd.DataFrame, key: Sequence[str]) -> list[dict[str, str]]:
    return [] if frame.empty else frame[list(key)].astype(str).to_dict("records")


def changed(
    table: str, column: str, old: pd.DataFrame, new: pd.DataFrame, rows, key: Sequence[str]
) -> list[Difference]:
    """The rows, of two aligned tables, in which a column has changed.

    Args:
        rows: whether each has.
    """
    picked = np.asarray(rows)
    if not picked.any():
        return []
    old, new = old[picked], new[picked]
    return [
        Difference(table, CHANGED, column, f"{column}: {was} -> {now}: {name}", row, str(was), str(now))
        for name, row, was, now in zip(old.index, _words(old, key), old[column], new[column], strict=True)
    ]
