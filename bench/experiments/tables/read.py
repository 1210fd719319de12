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
import os
from collections.abc import Sequence
from pathlib import Path

import numpy as np

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
    return rows_where(frame, (frame["converged"] != "no").to_numpy(bool))


def provenance() -> dict:
    """Return the contents of provenance.json: how the results were made."""
    return read_provenance(folder())


def own_laws(run: Path | None = None) -> tuple[Law, ...]:
    """Return the user's laws that took part in a run, see `kept_laws`; in the chosen folder's if none is named."""
    run = run or folder()
    return kept_laws(run, table(run, "costs"))


@functools.cache
def table(path: Path, name: str, columns: tuple[str, ...] | None = None) -> pd.DataFrame:
    """Return the table `name` of the folder `path`, all its columns if none is named. Copy it before you change it.

    If the rows of the table belong to laws, the column `contender` has the name of the law.
    """
    from bench.experiments.tables.store import read

    frame = read(path, name, columns)
    declared = {column.name for column in declared_table(name).columns() if column.type == WORD}
    declared.intersection_update(columns or declared)
    is_word = {str(column): isinstance(kind, pd.CategoricalDtype) for column, kind in frame.dtypes.items()}
    found = {column for column in is_word if is_word[column]}
    # Numbers may be missing: a metric may be newer than the run.
    for column in sorted(declared ^ found):
        raise BadResults(f"{path}: table {name} has no column {column} as ours is; run again")
    return with_contender(frame) if {"controller", "regulator"} & {*frame} else frame


def with_contender(frame: pd.DataFrame) -> pd.DataFrame:
    """Return the frame with `contender` added, as the command line writes it; each combination is named only once."""
    columns = [name for name in MARKS if name in frame]
    first, number = number_rows(frame, columns)
    names = [""] * len(first)
    for column in columns:
        words = frame[column].iloc[first].astype(object)
        for place, word in enumerate(words):
            if word:
                names[place] += MARKS[column] + word
    categories = sorted(set(names))
    code_of = {name: code for code, name in enumerate(categories)}
    codes = np.array([code_of[name] for name in names], dtype=int)
    return frame.assign(contender=pd.Categorical.from_codes(codes[number], categories))


def number_rows(frame: pd.DataFrame, columns: Sequence[str]) -> tuple[np.ndarray, np.ndarray]:
    """Return the places of the first rows of each combination of values, ascending, and each row's number of these."""
    combined = np.zeros(len(frame), dtype=np.int64)
    for name in columns:
        values = frame[name].array
        codes = values.codes if isinstance(values, pd.Categorical) else pd.factorize(values)[0]
        if (codes == codes[:1]).all():
            continue  # a word that all rows share tells none of them apart
        numbers, _ = pd.factorize(codes)
        combined = combined * (numbers.max() + 1) + numbers
    _, first, number = np.unique(combined, return_index=True, return_inverse=True)
    order = np.argsort(first)
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    return first[order], place[number]


def chosen(frame: pd.DataFrame, words: dict[str, str]) -> pd.DataFrame:
    """Return the rows whose columns have these words, renumbered from 0, with only the words that occur."""
    frame = matching(frame, words)
    of_words = [str(column) for column, kind in frame.dtypes.items() if isinstance(kind, pd.CategoricalDtype)]
    return frame.assign(**{column: occurring(frame[column].array) for column in of_words})


def matching(frame: pd.DataFrame, words: dict[str, str]) -> pd.DataFrame:
    """Return the rows whose columns have these words, renumbered from 0; columns may know words that do not occur."""
    if words:
        frame = rows_where(frame, has_words(frame, words))
    return frame.reset_index(drop=True)


def rows_where(frame: pd.DataFrame, is_chosen: np.ndarray) -> pd.DataFrame:
    """Return some rows; where they stand together, as those of a law do, nothing is copied."""
    places = is_chosen.nonzero()[0]
    if len(places) and places[-1] - places[0] + 1 == len(places):
        return frame.iloc[places[0] : places[-1] + 1]
    return frame.iloc[places]


def has_words(frame: pd.DataFrame, words: dict[str, str]) -> np.ndarray:
    """Return whether each row has these words in these columns; BadResults: there is no such column."""
    unknown = next((column for column in words if column not in frame), None)
    if unknown is not None:
        raise BadResults(f"no column '{unknown}' in this table; it has: {', '.join(map(str, frame.columns))}")
    has = np.ones(len(frame), dtype=bool)
    for column, word in words.items():
        has &= (frame[column] == word).to_numpy(bool)
    return has


def occurring(words: pd.Categorical) -> pd.Categorical:
    """Return a column of words with only those categories that occur in it."""
    is_used = np.zeros(len(words.categories) + 1, dtype=bool)
    is_used[words.codes] = True  # a word that is missing has code -1, the last place
    if is_used[:-1].all():
        return words
    code = np.cumsum(is_used) - 1
    code[-1] = -1
    categories = words.categories[is_used[:-1]]
    return pd.Categorical.from_codes(code[words.codes], categories, ordered=words.ordered, validate=False)
