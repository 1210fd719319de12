"""Results on disk: tables with their schema, written whole or not at all (files.py), checked when read.

A folder may come from anywhere. Nothing is read but parquet and JSON, which hold no code; a link is refused, so that
nothing outside the folder is read or written; and a word holds no sign that a page or a terminal takes for its own.
"""

import json
import os
import re
from collections.abc import Callable, Iterable
from pathlib import Path

import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq

from bench.base.errors import BadResults, NoTable
from bench.base.files import read_json, refuse_link, write_atomically
from bench.experiments.columns import VERSION, Table
from bench.experiments.experiment import Unit, experiment_of, known_experiments, known_tables, rows_of
from bench.experiments.request import Request
from bench.experiments.tables.schema import name_of, table_of

# Arrow's usual pool gives memory back at once, and each table then pays again for new pages: a tenth of what
# `bench claims` takes.
pa.set_memory_pool(pa.system_memory_pool())


def encoding(schema: pa.Schema) -> dict:
    """Say how columns are written: numbers with a fraction, which seldom repeat, by all first bytes, then all second.

    Neighbours share their sign and exponent, so that a default run takes 11 MB and not 15.5; words and counts go into
    a dictionary, and so do settling times: they are whole control periods, which repeat (half of a map's bytes).
    """
    floats = [column.name for column in schema if pa.types.is_floating(column.type)]
    split = [name for name in floats if name != "settling_time_s"]
    return {
        "compression": "zstd",
        "write_page_checksum": True,
        "use_byte_stream_split": split,
        "use_dictionary": [name for name in schema.names if name not in split],
    }


LONGEST_WORD = 200
PLAIN = re.compile(rf"[A-Za-z0-9 .,+_/~@=-]{{0,{LONGEST_WORD}}}")
"""A word of a table: names of contenders, starts, outcomes, nothing that HTML, Markdown or TeX would read."""

FREE_WORDS = ("libraries", "closed_loop", "verdicts")
"""Tables whose words are not PLAIN: other libraries' functions, asked in this checkout, never a run's."""


def as_table(frame: pd.DataFrame, table: str | Table) -> pa.Table:
    """Return a data frame in the table's schema, columns in its order."""
    schema = table_of(table).schema()
    if frame.empty:
        return schema.empty_table()
    columns = [pa.array(frame[column.name].to_numpy(), column.type, from_pandas=True) for column in schema]
    return pa.Table.from_arrays(columns, schema=schema)  # Table.from_pandas takes twice the time for 20 rows


def table_of_unit(request: Request, unit: Unit) -> pa.Table:
    """Return the rows of a unit."""
    return as_table(rows_of(request, unit), experiment_of(unit).table)


def lost_table(request: Request, unit: Unit, outcome: str) -> pa.Table:
    """Return what is left of a unit whose law crashed or hung."""
    experiment = experiment_of(unit)
    return as_table(pd.DataFrame(experiment.lost(request, unit, outcome)), experiment.table)


def write_table(path: Path, frame: pd.DataFrame | pa.Table, table: str | Table, about: dict | None = None) -> None:
    """One table, whole or not at all; `about` goes into its metadata as JSON, for a table that has no run's folder."""
    arrow = frame if isinstance(frame, pa.Table) else as_table(frame, table)
    if about is not None:
        arrow = arrow.replace_schema_metadata({**arrow.schema.metadata, b"about": json.dumps(about, sort_keys=True)})
    write_atomically(path, lambda temporary: pq.write_table(arrow, temporary, **encoding(arrow.schema)))


GROUP = 16_384
"""Rows that a merge holds in memory, some 10 MB; row groups of a part each made the file three times as large."""

PARTS = 64
"""Tables that a merge holds at most; each takes 50 kB beside its rows, as much as those of a hundred episodes."""


def merge(path: Path, parts: Iterable[pa.Table], table: str | Table, group: int = GROUP) -> int:
    """Write all parts in their order as one table, at most `group` rows and one part in memory; the number of rows."""
    rows = 0

    def write(temporary: str) -> None:
        nonlocal rows
        schema = table_of(table).schema()
        with pq.ParquetWriter(temporary, schema, **encoding(schema)) as writer:
            held: list[pa.Table] = []
            for part in parts:
                held.append(part)
                rows += held[-1].num_rows
                if len(held) == PARTS:
                    held = [joined(held)]
                if sum(one.num_rows for one in held) >= group:
                    writer.write_table(joined(held))
                    held.clear()
            if held:
                writer.write_table(joined(held))

    write_atomically(path, write)
    return rows


def joined(tables: list[pa.Table]) -> pa.Table:
    """Return the tables as one whole, words in one dictionary."""
    return pa.concat_tables(tables).unify_dictionaries().combine_chunks()


def read_arrow(path: Path, table: str | Table, columns: Iterable[str] | None = None) -> pa.Table:
    """Return a table of ours with its schema checked; BadResults if it is missing, truncated, or of another schema.

    columns: those that are read, of which the file may lack some; all of them if None.
    """

    def open_file() -> pa.Table:
        file = pq.ParquetFile(path, page_checksum_verification=True)
        return file.read(columns=columns and list(columns), use_threads=False)

    return _checked(path, name_of(table), open_file)


def check(path: Path, table: str | Table) -> None:
    """Make the checks of `read_arrow` from the file's end alone, where parquet keeps its schema."""
    _checked(path, name_of(table), lambda: pq.read_schema(path).empty_table())


def _checked(path: Path, table: str, opened: Callable) -> pa.Table:
    refuse_link(Path(path))
    try:
        arrow = opened()
    except FileNotFoundError:
        raise NoTable(f"{path}: there is no such file; run `make bench` (or bench run) first") from None
    except (OSError, pa.ArrowException) as error:
        reason = str(error).splitlines()[0]
        raise BadResults(f"{path}: it is truncated or no parquet file ({reason}); delete it and run again") from error
    metadata = arrow.schema.metadata or {}
    version = metadata.get(b"orientation-bench schema", b"none").decode(errors="replace")
    if metadata.get(b"orientation-bench table", b"").decode(errors="replace") != table or version != VERSION:
        raise BadResults(
            f"{path}: its schema is '{version:.60}', this program reads '{VERSION}' of table '{table}'; run again into "
            "another folder with --out"
        )
    if table not in FREE_WORDS:
        _refuse_words(path, arrow)
    return arrow


def _refuse_words(path: Path, arrow: pa.Table) -> None:
    """Columns hold numbers or PLAIN words, and nothing else."""
    for name, column in zip(arrow.schema.names, arrow.columns, strict=True):
        kind = column.type
        if pa.types.is_dictionary(kind) and pa.types.is_string(kind.value_type):
            words = {word for chunk in column.chunks for word in chunk.dictionary.to_pylist()}
        elif pa.types.is_integer(kind) or pa.types.is_floating(kind):
            continue
        else:
            raise BadResults(f"{path}: column {name!r} holds {kind}, and ours hold words and numbers; delete the file")
        for word in words:
            if word is None or not PLAIN.fullmatch(word):
                raise BadResults(f"{path}: {word!r:.80} in column {name!r} is no word of ours; delete the file")


def read_name(path: Path) -> str:
    """Return the name of the table that a file says it is; BadResults if it is no parquet file that can be read."""
    refuse_link(Path(path))
    try:
        metadata = pq.read_schema(path).metadata or {}
    except FileNotFoundError:
        raise NoTable(f"{path}: there is no such file; run `make bench` (or bench run) first") from None
    except (OSError, pa.ArrowException) as error:
        reason = str(error).splitlines()[0]
        raise BadResults(f"{path}: it is no parquet file ({reason}); give one of a results folder") from error
    return metadata.get(b"orientation-bench table", b"").decode(errors="replace")


def frame(path: Path, table: str | Table, columns: Iterable[str] | None = None) -> pd.DataFrame:
    """Return a file of a table as a data frame, or some of its columns, read and checked by `read_arrow`."""
    rows = read_arrow(path, table, columns).to_pandas(ignore_metadata=True, use_threads=False)
    # pandas finds a column among Python's words in a third of the time that it takes among Arrow's.
    rows.columns = pd.Index(rows.columns, dtype=object)
    return rows


def read(folder: Path, table: str | Table, columns: Iterable[str] | None = None) -> pd.DataFrame:
    """Return one table of a run, BadResults if it has not finished; without rows if its experiment is newer than it.

    columns: those that are read, see `read_arrow`.
    """
    name, folder = name_of(table), Path(folder)
    if not folder.is_dir():
        raise BadResults(f"{folder}: there is no such folder; run `make bench` (or bench run) first")
    if not (folder / "provenance.json").is_file():
        raise BadResults(f"{folder}: the run there has not finished; the same `bench run` command resumes it")
    path = folder / f"{name}.parquet"
    if not os.path.lexists(path) and name in find_newer(folder):
        return table_of(table).schema().empty_table().to_pandas(ignore_metadata=True)
    return frame(path, name, columns)


def find_newer(folder: Path) -> list[str]:
    """Return the tables of experiments that are newer than a run: no file there, and nothing of them in its plan."""
    missing = [name for name in known_tables() if not os.path.lexists(Path(folder) / f"{name}.parquet")]
    plan = Path(folder) / "plan.json"
    if not (missing and plan.is_file()):
        return []
    units = read_json(plan).get("units")
    planned = [unit[:1] for unit in (units if isinstance(units, list) else []) if isinstance(unit, list)]
    known = {one.table.name for name, one in known_experiments().items() if [name] in planned}
    return [name for name in missing if name not in known]
