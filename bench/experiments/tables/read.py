"""What the report and the claims read: the folder of a finished run, and its tables, each read once a process.

    read.episodes(engine="ideal-rk4", start_set="uniform")     the rows that have these words
    read.costs(), read.boundaries(), read.poses(), read.traces(), read.compliance()
    read.provenance(), read.own_laws()

Every frame about contenders has a column `contender`: "regulator" or "regulator/representation", on an arm
"...@jacobian+inverse", and in contact "controller/representation+form". Rows about the free body are those that have
the words FREE_BODY.
"""

from __future__ import annotations

import functools
import operator
import os
from pathlib import Path

from bench.base.errors import BadResults
from bench.base.on_first_use import pd
from bench.base.provenance import read_provenance
from bench.experiments.columns import WORD
from bench.experiments.tables.kept_laws import kept_laws
from bench.experiments.tables.schema import RESULTS, declared_table
from bench.law.kinds import Law

VARIABLE = "ORIENTATION_BENCH_RESULTS"

FREE_BODY = {"jacobian": ""}
"""The words of every row about the body that turns freely, whatever the table: only an arm has a Jacobian."""

MARKS = {"controller": "", "regulator": "", "representation": "/", "jacobian": "@", "inverse": "+", "form": "+"}
"""Columns that name a contender -> what stands before each word but the first."""


def folder() -> Path:
    """Return the folder of results that `rows` and `provenance` read.

    The environment variable ORIENTATION_BENCH_RESULTS can name the folder. If the variable is not set, the folder is
    results/latest if the run in this folder is finished, and results/reference otherwise.
    """
    named = os.environ.get(VARIABLE)
    if named:
        return Path(named).expanduser().resolve()
    finished = (RESULTS / "latest" / "provenance.json").is_file()
    return RESULTS / ("latest" if finished else "reference")


def rows(name: str, **words: str) -> pd.DataFrame:
    """Return the rows of a table that have the given values in the given columns.

    For example: `rows("episodes", engine="native", start_set="poles")`.
    """
    return chosen(table(folder(), name), words)


episodes, traces, costs, boundaries, poses, compliance, robustness = (
    functools.partial(rows, name)
    for name in ("episodes", "traces", "costs", "boundaries", "poses", "compliance", "robustness")
)


def converged(frame: pd.DataFrame) -> pd.DataFrame:
    """Return all episodes of a table, without the episodes whose outcome changes if the time step is shorter."""
    return frame[frame["converged"] != "no"]


def provenance() -> dict:
    """Return the contents of provenance.json: how the results were made."""
    return read_provenance(folder())


def own_laws(run: Path | None = None) -> tuple[Law, ...]:
    """Return the user's laws that took part in a run, see `kept_laws`; in the chosen folder's if none is named."""
    run = run or folder()
    return kept_laws(run, table(run, "costs"))


@functools.cache
def table(path: Path, name: str) -> pd.DataFrame:
    """Return the whole table `name` of the folder `path`. Copy the table before you change it.

    If the rows of the table belong to laws, the column `contender` has the name of the law.
    """
    from bench.experiments.tables.store import read

    frame = read(path, name)
    declared = {column.name for column in declared_table(name).columns() if column.type == WORD}
    is_word = {str(column): isinstance(kind, pd.CategoricalDtype) for column, kind in frame.dtypes.items()}
    found = {column for column in is_word if is_word[column]}
    # Numbers may be missing: a metric may be newer than the run.
    for column in sorted(declared ^ found):
        raise BadResults(f"{path}: table {name} has no column {column} as ours is; run again")
    return with_contender(frame) if {"controller", "regulator"} & {*frame} else frame


def with_contender(frame: pd.DataFrame) -> pd.DataFrame:
    """Return the frame with `contender` added, as the command line writes it; each combination is named only once."""
    columns = [name for name in MARKS if name in frame]
    words = frame[columns]
    few = words.drop_duplicates().astype(str)
    names = few[columns[0]]
    for name in columns[1:]:
        names = names.where(few[name] == "", names + MARKS[name] + few[name])
    number = words.groupby(columns, observed=True, sort=False).ngroup()
    return frame.assign(contender=names.astype("category").array.take(number.to_numpy()))


def chosen(frame: pd.DataFrame, words: dict[str, str]) -> pd.DataFrame:
    """Return the rows whose columns have these words, renumbered from 0, with only the words that occur."""
    unknown = next((column for column in words if column not in frame), None)
    if unknown is not None:
        raise BadResults(f"no column '{unknown}' in this table; it has: {', '.join(map(str, frame.columns))}")
    if words:  # all columns are taken once, not once a word
        frame = frame[functools.reduce(operator.and_, (frame[column] == word for column, word in words.items()))]
    frame = frame.reset_index(drop=True)
    for column in frame.select_dtypes("category"):
        frame[column] = frame[column].cat.remove_unused_categories()
    return frame
