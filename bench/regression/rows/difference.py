"""Find and describe what differs between two tables: rows that only one has, and cells."""

from collections.abc import Callable, Iterable, Sequence
from itertools import groupby
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from bench.experiments.columns import Table

MISSING, NEW, TWICE, COLUMN, CHANGED, JUDGE = "missing", "new", "twice", "column", "changed", "judge"
SHOWN = 10  # lines of one kind
NAMES = {"regulator", "law", "controller", "shipped", "axis", "arm"}  # they name a law, a perturbation or an arm


class Difference(NamedTuple):
    """One thing that differs: in which column ("" for a whole row), in words, the row's key, and the two values."""

    table: str
    kind: str
    column: str
    says: str
    row: dict[str, str]
    was: str = ""
    now: str = ""


class ComparisonRule(NamedTuple):
    """How cells are compared: numbers by a tolerance (column -> relative, absolute) in some rows, words exactly.

    exact: columns that are compared first, exactly, each in some rows.
    """

    tolerance: Callable[[str], tuple[float | np.ndarray, float | np.ndarray]]
    rows: np.ndarray | bool = True
    exact: dict[str, np.ndarray] = {}  # noqa: RUF012  a tuple's default, never written to
    skipped: tuple[str, ...] = ()


def write_lines(differences: Iterable[Difference]) -> list[str]:
    """Return what differs in lines, SHOWN of a kind."""
    lines = []
    for (table, kind, column), group in groupby(differences, lambda one: (one.table, one.kind, one.column)):
        same = [one.says for one in group]
        shown = len(same) if kind == COLUMN else SHOWN
        lines += same[:shown]
        lines += [f"{column or f'{table}: row is {kind}'}: ... and {len(same) - shown} more"] * (len(same) > shown)
    return lines


def align_rows(
    table: Table, old: pd.DataFrame, new: pd.DataFrame
) -> tuple[pd.DataFrame, pd.DataFrame, list[Difference]]:
    """Return the rows that both have, in one order and named by their key, and what only one has."""
    old, new = (_name_rows(frame, table.key) for frame in (old, new))
    found = []
    for name, frame in (("base", old), ("head", new)):
        found += _describe_rows(table, TWICE, f"row twice in the {name}", frame[frame.index.duplicated()])
    if found:
        return old.iloc[:0], new.iloc[:0], found
    found += _describe_rows(table, MISSING, "row is missing", old[~old.index.isin(new.index)])
    found += _describe_rows(table, NEW, "row is new", new[~new.index.isin(old.index)])
    both = old.index.intersection(new.index, sort=False)
    return old.loc[both], new.loc[both], found


def _name_rows(frame: pd.DataFrame, key: Sequence[str]) -> pd.DataFrame:
    names = [" ".join(word for word in row.values() if word not in ("", "0")) for row in _read_keys(frame, key)]
    return frame.set_axis(pd.Index(names, dtype=str), axis=0)


def _describe_rows(table: Table, kind: str, words: str, frame: pd.DataFrame) -> list[Difference]:
    named = zip(frame.index, _read_keys(frame, table.key), strict=True)
    return [Difference(table.name, kind, "", f"{table.name}: {words}: {name}", row) for name, row in named]


def _read_keys(frame: pd.DataFrame, key: Sequence[str]) -> list[dict[str, str]]:
    """Return the words that name each row; numbers, as those of an axis, to nine digits."""
    is_float = {name: frame[name].dtype.kind == "f" for name in key}
    words = {name: frame[name].map("{:.9g}".format) if is_float[name] else frame[name].astype(str) for name in key}
    return pd.DataFrame(words, dtype=str).to_dict("records")


def compare_cells(
    table: Table, old: pd.DataFrame, new: pd.DataFrame, rule: ComparisonRule
) -> list[Difference]:
    """Return the cells that differ between two aligned tables."""
    found = []
    for name, rows in rule.exact.items():
        found += _describe_cells(table, name, old, new, rows & (old[name].astype(str) != new[name].astype(str)))
    for name in old.columns.difference([*table.key, *rule.exact, *rule.skipped], sort=False):
        if old[name].dtype.kind in "iuf":
            relative, absolute = rule.tolerance(name)
            pair = (new[name].to_numpy(float), old[name].to_numpy(float))
            differs = rule.rows & ~np.isclose(*pair, rtol=relative, atol=absolute, equal_nan=True)
        else:
            differs = new[name].astype(str) != old[name].astype(str)
        found += _describe_cells(table, name, old, new, differs)
    return found


def _describe_cells(table: Table, column: str, old: pd.DataFrame, new: pd.DataFrame, rows: Any) -> list[Difference]:
    picked = np.asarray(rows)
    if not picked.any():
        return []
    old, new = old[picked], new[picked]
    # ten digits: 3.627, where so many ticks add up to 3.6270000000000002
    cells = ([f"{cell:.10g}" if isinstance(cell, float) else str(cell) for cell in one[column]] for one in (old, new))
    return [
        Difference(table.name, CHANGED, column, f"{column}: {was} -> {now}: {name}", row, was, now)
        for name, row, was, now in zip(old.index, _read_keys(old, table.key), *cells, strict=True)
    ]
