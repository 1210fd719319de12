"""What differs between two runs: one row or column, and how a list of them is said."""

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from itertools import groupby
from typing import NamedTuple

import numpy as np
import pandas as pd

from bench.experiments.columns import Table

MISSING, NEW, TWICE, COLUMN, CHANGED, JUDGE = "missing", "new", "twice", "column", "changed", "judge"

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
        said += same if kind in (COLUMN, JUDGE) else same[:SHOWN]
        if kind not in (COLUMN, JUDGE) and len(same) > SHOWN:
            said.append(f"{column or f'{table}: row is {kind}'}: ... and {len(same) - SHOWN} more")
    return said


def by_column(differences: Sequence[Difference]) -> list[Difference]:
    """What a judge that changed made differ: how many rows, by table and column."""
    counts = Counter((one.table, one.column or f"rows {one.kind}") for one in differences)
    first = f"the judge changed: {len(differences)} differences, by column; laws are not compared"
    said = [(table, column, f"{table}: {column}: {count}") for (table, column), count in counts.items()]
    return [Difference(table, JUDGE, column, says, {}) for table, column, says in [("", "", first), *said]]


def aligned(table: Table, old: pd.DataFrame, new: pd.DataFrame) -> tuple[pd.DataFrame, pd.DataFrame, list[Difference]]:
    """The rows that both have, in one order and named by their key, and what only one has."""
    old, new = (_keyed(frame, table.key) for frame in (old, new))
    found = []
    for name, frame in (("base", old), ("head", new)):
        found += _rows(table, TWICE, f"row twice in the {name}", frame[frame.index.duplicated()])
    if found:
        return old.iloc[:0], new.iloc[:0], found
    found += _rows(table, MISSING, "row is missing", old[~old.index.isin(new.index)])
    found += _rows(table, NEW, "row is new", new[~new.index.isin(old.index)])
    both = old.index.intersection(new.index, sort=False)
    return old.loc[both], new.loc[both], found


def _keyed(frame: pd.DataFrame, key: Sequence[str]) -> pd.DataFrame:
    rows = frame[list(key)].astype(str).itertuples(index=False)
    return frame.set_axis(pd.Index([" ".join(filter(None, row)) for row in rows], dtype=str), axis=0)


def _rows(table: Table, kind: str, words: str, frame: pd.DataFrame) -> list[Difference]:
    named = zip(frame.index, _words(frame, table.key), strict=True)
    return [Difference(table.name, kind, "", f"{table.name}: {words}: {name}", row) for name, row in named]


def _words(frame: pd.DataFrame, key: Sequence[str]) -> list[dict[str, str]]:
    return [] if frame.empty else frame[list(key)].astype(str).to_dict("records")


def changed(table: Table, column: str, old: pd.DataFrame, new: pd.DataFrame, rows) -> list[Difference]:
    """The rows, of two aligned tables, in which a column has changed.

    Args:
        rows: whether each has.
    """
    picked = np.asarray(rows)
    if not picked.any():
        return []
    old, new = old[picked], new[picked]
    # ten digits: 3.627, where so many ticks add up to 3.6270000000000002
    cells = ([f"{cell:.10g}" if isinstance(cell, float) else str(cell) for cell in one[column]] for one in (old, new))
    return [
        Difference(table.name, CHANGED, column, f"{column}: {was} -> {now}: {name}", row, was, now)
        for name, row, was, now in zip(old.index, _words(old, table.key), *cells, strict=True)
    ]


Close = Callable[[str, np.ndarray, np.ndarray], np.ndarray]
"""(column, head's numbers, base's) -> which of them count as the same."""


def near(relative: np.ndarray | float, absolute: np.ndarray | float) -> Close:
    """The same to a tolerance, whatever the column; of each row its own, if they are arrays."""
    return lambda _, a, b: np.isclose(a, b, rtol=relative, atol=absolute, equal_nan=True)


def compared(
    table: Table, old: pd.DataFrame, new: pd.DataFrame, close: Close, rows=True, but: Sequence[str] = ()
) -> list[Difference]:
    """What differs between two aligned tables in columns that are no key: words exactly, numbers unless `close`.

    Args:
        rows: in which numbers are compared. but: columns that are not.
    """
    found = []
    for name in old.columns.difference([*table.key, *but], sort=False):
        if old[name].dtype.kind in "iuf":
            differs = rows & ~close(name, new[name].to_numpy(float), old[name].to_numpy(float))
        else:
            differs = new[name].astype(str) != old[name].astype(str)
        found += changed(table, name, old, new, differs)
    return found
