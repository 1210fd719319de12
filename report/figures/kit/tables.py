"""Plain tables, declared: the columns in their order with their units, and how each one's numbers are written."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import pandas as pd

from report.figures.kit import html


class Table:
    """A table of a page, in Markdown: numbers to the right, words to the left, gaps as a dash.

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
        if unknown := sorted(set(self.formats) - set(self.heads)):
            raise ValueError(f"formats names {unknown}, not columns of the table; known: {self.heads}")

    def __call__(self, rows: Iterable) -> html.Markdown | None:
        """Return the table as Markdown.

        Args:
            rows: a frame or mappings with these heads, or sequences in their order; none makes no table.
        """
        frame = pd.DataFrame(rows if isinstance(rows, pd.DataFrame) else list(rows), columns=self.heads)
        if frame.empty:
            return None
        numbers = {name for name in self.heads if pd.api.types.is_numeric_dtype(frame[name])} - set(self.words)
        rule = ["--:" if name in numbers else ":--" for name in self.heads]
        forms = [self.formats.get(head) for head in self.heads]
        cells = (
            [html.keep_count(html.cell(value, form)) for value, form in zip(row, forms, strict=True)]
            for row in frame.itertuples(index=False, name=None)
        )
        return html.Markdown("\n".join(f"| {' | '.join(line)} |" for line in (self.heads, rule, *cells)))
