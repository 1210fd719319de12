"""A column and a table: names, types, units and meanings, and what names a row."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import pyarrow as pa

VERSION = "2"
WORD, NUMBER, COUNT, SINGLE = "word", "double", "int64", "float"
"""Types of columns: of a word, as parquet's dictionary; of others, their names in Arrow. SINGLE is where seven digits
are enough: sizes of what is nearly zero, condition numbers, measures of robustness."""


class Column(NamedTuple):
    """One column of a table."""

    name: str
    type: str
    unit: str
    meaning: str


def words(**meanings: str) -> list[Column]:
    """Columns of words."""
    return [Column(name, WORD, "", meaning) for name, meaning in meanings.items()]


def numbers(unit: str, meaning: str, *names: str) -> list[Column]:
    """Columns of numbers with the same unit and meaning."""
    return [Column(name, NUMBER, unit, meaning) for name in names]


class Table(NamedTuple):
    """A table: the file <name>.parquet.

    columns() -> its columns, in order; they may depend on what metrics there are. key: the columns that name a row.
    """

    name: str
    columns: Callable[[], list[Column]]
    key: tuple[str, ...]

    @property
    def names(self) -> list[str]:
        """Of the columns."""
        return [one.name for one in self.columns()]

    def schema(self) -> pa.Schema:
        """As parquet keeps it, units and meanings as the columns' metadata."""
        import pyarrow as pa  # names of tables and columns need it not

        types = {WORD: pa.dictionary(pa.int32(), pa.string())}
        types |= {name: pa.type_for_alias(name) for name in (NUMBER, COUNT, SINGLE)}
        fields = [
            pa.field(one.name, types[one.type], metadata={"unit": one.unit, "meaning": one.meaning})
            for one in self.columns()
        ]
        return pa.schema(fields, metadata={"orientation-bench table": self.name, "orientation-bench schema": VERSION})
