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
        has &= _is_any(frame[column], word if isinstance(word, tuple) else (word,))
    return has


def _is_any(values: pd.Series, words: tuple[str, ...]) -> np.ndarray:
    """Return whether each value is one of the words; of a column of words, by its codes, which takes a tenth of it."""
    if not isinstance(values.dtype, pd.CategoricalDtype):
        return values.isin(words).to_numpy(bool)
    codes, categories = values.array.codes, values.array.categories
    is_any = np.zeros(len(codes), dtype=bool)
    for word in words:
        if word in categories:
            is_any |= codes == categories.get_loc(word)
    return is_any


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


LARGEST = 2**62
"""Bound of the numbers of combinations while they are made."""


def number_rows(frame: pd.DataFrame, columns: Sequence[str]) -> tuple[np.ndarray, np.ndarray]:
    """Return the places of the first rows of each combination of values, ascending, and each row's number of these."""
    combined, count = np.zeros(len(frame), dtype=np.int64), 1
    for name in columns:
        codes, number_of_values = _codes_of(frame[name].array)
        if (codes == codes[:1]).all():
            continue  # a word that all rows share tells none of them apart
        if count * number_of_values >= LARGEST:
            combined, combinations = pd.factorize(combined)
            count = len(combinations)
        combined = combined * number_of_values + codes
        count *= number_of_values
    number, combinations = pd.factorize(combined)
    first = np.empty(len(combinations), dtype=np.int64)
    first[number[::-1]] = np.arange(len(frame))[::-1]  # of several values for one place, the last one stays
    return first, number


def _codes_of(values: pd.api.extensions.ExtensionArray) -> tuple[np.ndarray, int]:
    """Return a number from 0 for each value, equal for equal ones, and the count of numbers; 0 where it is missing."""
    if isinstance(values, pd.Categorical):
        return values.codes.astype(np.int64) + 1, len(values.categories) + 1
    codes, names = pd.factorize(values)
    return codes + 1, len(names) + 1
