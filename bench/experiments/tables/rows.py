"""Choose rows of a frame by their words, and number their combinations, without copying what need not be copied."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from bench.base.errors import BadResults
from bench.base.on_first_use import pd

Words = str | tuple[str, ...]
"""A word of a column, or several of which a row has any."""


def matching(frame: pd.DataFrame, words: Mapping[str, Words]) -> pd.DataFrame:
    """Return the rows with these words, renumbered from 0; columns may know words that do not occur."""
    rows = rows_where(frame, has_words(frame, words)) if words else frame
    return rows.reset_index(drop=True)


def rows_where(frame: pd.DataFrame, is_chosen: np.ndarray) -> pd.DataFrame:
    """Return some rows; where they stand together, as those of a law do, nothing is copied."""
    places = is_chosen.nonzero()[0]
    if len(places) and places[-1] - places[0] + 1 == len(places):
        return frame.iloc[places[0] : places[-1] + 1]
    return frame.iloc[places]


def has_words(frame: pd.DataFrame, words: Mapping[str, Words]) -> np.ndarray:
    """Return whether each row has these words; BadResults: the frame has no such column."""
    has = np.ones(len(frame), dtype=bool)
    for column, word in words.items():
        if column not in frame:
            known = ", ".join(map(str, frame.columns))
            raise BadResults(f"no column '{column}' in this table; it has: {known}")
        is_any = frame[column].isin(word) if isinstance(word, tuple) else frame[column] == word
        has &= is_any.to_numpy(bool)
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
