"""Plain tables, declared: the columns in their order with their units, and how each one's numbers are written."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import pandas as pd

from report.figures.kit import html


class Table:
    """A table of a page.

        TIMES = Table({"Law": "", "Starts": "", "Settled [%]": ".1f"})
        TIMES(rows)

    Args:
        columns: head of each column, its unit in brackets -> ".2f", "{:.2f} s" or a function; "" for three figures.
        words: columns that are set as words, to the left, although they hold numbers.
    """

    def __init__(self, columns: Mapping[str, str | Callable[[Any], str]], words: Iterable[str] = ()):
        self.heads = list(columns)
        self.formats = {head: form for head, form in columns.items() if form}
        self.words = tuple(words)

    def __call__(self, rows: Iterable) -> html.Markdown | None:
        """As Markdown.

        Args:
            rows: a frame or mappings with these heads, or sequences in their order; none makes no table.
        """
        frame = pd.DataFrame(rows if isinstance(rows, pd.DataFrame) else list(rows), columns=self.heads)
        return html.table(frame, self.formats, self.words) if len(frame) else None
