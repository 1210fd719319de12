"""Plain tables, declared: the columns in their order with their units, and how each one's numbers are written."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import pandas as pd

from report.figures.kit import html


class Table:
    """A table of a page.

        TIMES = Table("Law | Starts | Settled [%]:.1f | Error", {"Error": power})
        TIMES(rows)

    Args:
        columns: heads with their units, each with the format of its numbers if three figures are not what it wants.
        forms: head -> a function that writes its numbers.
        words: columns that are set as words, to the left, although they hold numbers.
    """

    def __init__(
        self, columns: str, forms: Mapping[str, Callable[[Any], str]] | None = None, words: Iterable[str] = ()
    ):
        parts = [one.strip().partition(":") for one in columns.split("|")]
        self.heads = [head for head, *_ in parts]
        self.formats = {head: form for head, _, form in parts if form} | dict(forms or {})
        self.words = tuple(words)

    def __call__(self, rows: Iterable) -> html.Markdown | None:
        """Return the table as Markdown.

        Args:
            rows: a frame or mappings with these heads, or sequences in their order; none makes no table.
        """
        frame = pd.DataFrame(rows if isinstance(rows, pd.DataFrame) else list(rows), columns=self.heads)
        return html.table(frame, self.formats, self.words) if len(frame) else None
