"""What a column and a table are. A table is declared by the TOML file of its name, beside the module that fills it.

    about    the file, a row of it, and what else must be known; results/README.md shows it
    key      the columns that name a row
    columns  in order: name = "meaning" of a word, ["unit", "meaning"] of a number, {int64 = "meaning"} of a count,
             {float = ["unit", "meaning"]} where seven digits are enough; several names, with spaces, share a meaning

CAPITALS stand for columns that tables share (shared.toml), in a key too, or for those that a module adds by that name.
"""

from __future__ import annotations

import functools
import json
import tomllib
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from tasks.verdict import CRASHED, OUTCOMES

if TYPE_CHECKING:
    import pyarrow as pa

VERSION = "2"
WORD, NUMBER, COUNT, SINGLE = "word", "double", "int64", "float"
"""Types of columns: parquet's dictionary of words, or names in Arrow; SINGLE where seven digits are enough."""


class Column(NamedTuple):
    """One column of a table."""

    name: str
    type: str
    unit: str
    meaning: str


class Table(NamedTuple):
    """A table, the file <name>.parquet. key: the columns that name a row. about: what it is, for results/README.md.

    columns() -> its columns, in order; they may depend on what metrics there are.
    """

    name: str
    columns: Callable[[], list[Column]]
    key: tuple[str, ...]
    about: str

    @property
    def names(self) -> list[str]:
        """Return the names of the columns."""
        return [one.name for one in self.columns()]

    def schema(self) -> pa.Schema:
        """Return the schema of the parquet file, with units and meanings as the columns' metadata.

        The units are in it twice: pandas drops the columns' metadata, and reads its own key PANDAS_ATTRS.
        """
        import pyarrow as pa  # names of tables and columns need it not

        types = {WORD: pa.dictionary(pa.int32(), pa.string())}
        types |= {name: pa.type_for_alias(name) for name in (NUMBER, COUNT, SINGLE)}
        fields = [
            pa.field(one.name, types[one.type], metadata={"unit": one.unit, "meaning": one.meaning})
            for one in self.columns()
        ]
        units = {one.name: one.unit for one in self.columns()}
        metadata = {
            "orientation-bench table": self.name,
            "orientation-bench schema": VERSION,
            "PANDAS_ATTRS": json.dumps({"units": units}),
        }
        return pa.schema(fields, metadata=metadata)


def read_columns(declared: dict[str, Any], groups: dict[str, Callable[[], list[Column]]]) -> list[Column]:
    """Return the columns that a TOML file declares; groups: those that a name in capitals stands for."""
    found: list[Column] = []
    for names, said in declared.items():
        if names in groups:
            found += groups[names]()
            continue
        ((kind, text),) = (
            said if isinstance(said, dict) else {NUMBER if isinstance(said, list) else WORD: said}
        ).items()
        unit, meaning = text if isinstance(text, list) else ("1" if kind == COUNT else "", text)
        found += [Column(name, kind, unit, meaning) for name in names.split()]
    return found


def read_shared() -> dict[str, list[Column]]:
    """Return the columns of shared.toml by the name that stands for them."""
    text = Path(__file__).with_name("shared.toml").read_text(encoding="utf-8")
    text = text.replace("{outcomes}", ", ".join(OUTCOMES[:CRASHED])).replace("{lost}", " or ".join(OUTCOMES[CRASHED:]))
    return {name: read_columns(declared, {}) for name, declared in tomllib.loads(text).items()}


SHARED = read_shared()
CONTENDER_KEY = tuple(one.name for one in SHARED["CONTENDER"])
"""The columns that name a contender."""


def read_table(file: str, name: str, **more: Callable[[], list[Column]]) -> Table:
    """Return the table that <name>.toml beside a module's file declares; more: the groups of columns that it adds."""
    return read_declared(Path(file).with_name(f"{name}.toml"), more)


def read_declared(path: Path, more: dict[str, Callable[[], list[Column]]]) -> Table:
    """Return the table that a TOML file declares, without those groups of columns that are neither shared nor in more.

    Such groups are what modules add: metrics and operations, all of them numbers.
    """
    words = tomllib.loads(path.read_text(encoding="utf-8"))
    groups: dict[str, Callable[[], list[Column]]] = {}
    for name in words["columns"]:
        if name.isupper():
            groups[name] = functools.partial(list, SHARED.get(name, ()))
    groups |= more
    key: list[str] = []
    for word in words["key"]:
        key += CONTENDER_KEY if word == "CONTENDER" else (word,)
    columns = functools.partial(read_columns, words["columns"], groups)
    return Table(path.stem, columns, tuple(key), words["about"])


def of_metrics(metrics: Iterable[Any], kind: str = NUMBER) -> list[Column]:
    """Return a column for each metric."""
    return [Column(one.column, kind, one.unit, one.title) for one in metrics]
