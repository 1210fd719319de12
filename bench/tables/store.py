"""Results on disk: tables with their schema, written whole or not at all, checked when read.

A file appears by rename after fsync, and its folder is synced after the rename: a process killed at any moment, or a
machine without power, leaves whole files only, and each that was finished.

A folder may come from anywhere. Nothing is read but parquet and JSON, which hold no code; a link is refused, so that
nothing outside the folder is read or written; and a word holds no sign that a page or a terminal takes for its own.
"""

import errno
import json
import os
import re
import tempfile
from collections.abc import Iterable, Iterator
from pathlib import Path

import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq

from bench.errors import BadResults
from bench.tables.schema import TABLES, VERSION, arrow_schema


def encoding(schema: pa.Schema) -> dict:
    """How columns are written: of numbers with a fraction, which seldom repeat, all first bytes, then all second ones.

    Neighbours share their sign and exponent, so that a default run takes 11 MB and not 15.5; words and counts go into
    a dictionary.
    """
    split = [column.name for column in schema if pa.types.is_floating(column.type)]
    return {
        "compression": "zstd",
        "use_byte_stream_split": split,
        "use_dictionary": [name for name in schema.names if name not in split],
    }


def write_atomically(path: Path, write) -> None:
    """Call write(temporary path), then put the file in its place; when this returns, it outlives a loss of power.

    Errors:
        BadResults: the folder cannot be made or written, or the disk is full; no temporary file stays.
    """
    path = Path(path)
    try:
        make_folder(path.parent)
        handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.", suffix=".tmp")
        os.close(handle)
    except OSError as error:
        raise refused(path.parent, error) from error
    try:
        write(temporary)
        with open(temporary, "rb") as file:
            os.fsync(file.fileno())
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
        _sync_folder(path.parent)
    except BaseException as error:
        Path(temporary).unlink(missing_ok=True)
        if isinstance(error, OSError):
            raise refused(path, error) from error
        raise


FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
"""The disk, a share of it, or what one file may take."""


def refused(path: Path, error: OSError) -> BadResults:
    """What the user is told of a file or folder that could not be written, with the cure."""
    is_full = error.errno in FULL
    reason = os.strerror(error.errno) if error.errno else error  # arrow's own text runs over lines
    cure = "make room and give the same command again" if is_full else "mend its rights"
    return BadResults(f"{path}: cannot be written ({reason}); {cure}, or choose another folder with --out")


def make_folder(folder: Path) -> None:
    """The folder and those above it, each known to the one that holds it before anything is put there."""
    new = [one for one in (folder, *folder.parents) if not one.exists()]
    folder.mkdir(parents=True, exist_ok=True)
    for one in new:
        _sync_folder(one.parent)


def _sync_folder(folder: Path) -> None:
    """Bring a folder's list of names to the disk, where the system can: a rename alone may be lost with the power."""
    if not hasattr(os, "O_DIRECTORY"):
        return
    handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def is_leftover(path: Path) -> bool:
    """Whether this is the temporary file of a write that was killed."""
    return path.name.startswith(".") and path.name.endswith(".tmp")


def write_json(path: Path, content: dict) -> None:
    """A JSON file, whole or not at all."""
    text = json.dumps(content, indent=1, sort_keys=True) + "\n"
    write_atomically(path, lambda temporary: Path(temporary).write_text(text, encoding="utf-8"))


PLAIN = re.compile(r"[A-Za-z0-9 .,+_/~@=-]{0,200}")
"""A word of a table: names of contenders, starts, outcomes, nothing that HTML, Markdown or TeX would read."""

FREE_WORDS = ("libraries",)
"""Tables whose words are not PLAIN: other libraries' functions, asked in this checkout, never a run's."""

MOST_JSON_BYTES = 200_000_000
"""A plan of 10^9 episodes takes half of it."""


def refuse_link(path: Path) -> None:
    """What lies in a results folder lies there itself.

    Errors:
        BadResults: the path is a symbolic link.
    """
    if path.is_symlink():
        raise BadResults(
            f"{path}: it is a link, and a results folder holds files of its own; put what it leads to in its place, "
            "if you trust it"
        )


def read_json(path: Path) -> dict:
    """A JSON file of ours.

    Errors:
        BadResults: missing, a link, too large, no object, or with texts that a terminal would obey.
    """
    path = Path(path)
    refuse_link(path)
    try:
        if path.stat().st_size > MOST_JSON_BYTES:
            raise BadResults(f"{path}: it has more than {MOST_JSON_BYTES:,} bytes, so it is none of ours; delete it")
        content = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise BadResults(f"{path}: there is no such file; the folder holds no run of ours") from None
    except (OSError, ValueError, RecursionError) as error:
        raise BadResults(f"{path}: cannot be read ({error}); delete the folder and run again") from error
    if not isinstance(content, dict):
        raise BadResults(f"{path}: it holds no JSON object, so it is none of ours; choose another folder with --out")
    if not all(text.isprintable() for text in _texts(content)):
        raise BadResults(f"{path}: a text in it holds signs that cannot be printed; delete the folder and run again")
    return content


def _texts(content) -> Iterator[str]:
    """Every text of a JSON value, names of fields too."""
    if isinstance(content, str):
        yield content
    elif isinstance(content, dict):
        for name, value in content.items():
            yield name
            yield from _texts(value)
    elif isinstance(content, list):
        for value in content:
            yield from _texts(value)


def as_table(frame: pd.DataFrame, table: str) -> pa.Table:
    """A data frame in the table's schema, columns in its order."""
    schema = arrow_schema(table)
    if frame.empty:
        return schema.empty_table()
    return pa.Table.from_pandas(frame[schema.names], schema=schema, preserve_index=False).replace_schema_metadata(
        schema.metadata
    )


def write_table(path: Path, frame: pd.DataFrame | pa.Table, table: str, about: dict | None = None) -> None:
    """One table, whole or not at all; `about` goes into its metadata as JSON, for a table that has no run's folder."""
    arrow = frame if isinstance(frame, pa.Table) else as_table(frame, table)
    if about is not None:
        arrow = arrow.replace_schema_metadata({**arrow.schema.metadata, b"about": json.dumps(about, sort_keys=True)})
    write_atomically(path, lambda temporary: pq.write_table(arrow, temporary, **encoding(arrow.schema)))


GROUP = 16_384
"""Rows that a merge holds in memory, some 10 MB; row groups of a part each made the file three times as large."""

PARTS = 64
"""Tables that a merge holds at most; each takes 50 kB beside its rows, as much as those of a hundred episodes."""


def merge(path: Path, parts: Iterable[Path], table: str) -> int:
    """All parts in their order as one table, at most GROUP rows and one part in memory; the number of rows."""
    rows = 0

    def write(temporary):
        nonlocal rows
        schema = arrow_schema(table)
        with pq.ParquetWriter(temporary, schema, **encoding(schema)) as writer:
            held: list[pa.Table] = []
            for part in parts:
                held.append(read_arrow(part, table))
                rows += held[-1].num_rows
                if len(held) == PARTS:
                    held = [joined(held)]
                if sum(one.num_rows for one in held) >= GROUP:
                    writer.write_table(joined(held))
                    held.clear()
            if held:
                writer.write_table(joined(held))

    write_atomically(path, write)
    return rows


def joined(tables: list[pa.Table]) -> pa.Table:
    """The tables as one whole, words in one dictionary."""
    return pa.concat_tables(tables).unify_dictionaries().combine_chunks()


def read_arrow(path: Path, table: str) -> pa.Table:
    """A table of ours with its schema checked.

    Errors:
        BadResults: missing, truncated, or of another schema; the message says which and the cure.
    """
    return _checked(path, table, lambda: pq.ParquetFile(path).read(use_threads=False))


def check(path: Path, table: str) -> None:
    """The same checks from the file's end alone, where parquet keeps its schema: what a truncated file lacks.

    Errors:
        BadResults: see `read_arrow`.
    """
    _checked(path, table, lambda: pq.read_schema(path).empty_table())


def _checked(path: Path, table: str, opened) -> pa.Table:
    refuse_link(Path(path))
    try:
        arrow = opened()
    except FileNotFoundError:
        raise BadResults(f"{path}: there is no such file; run `make bench` (or python -m bench run) first") from None
    except (OSError, pa.ArrowException) as error:
        reason = str(error).splitlines()[0]
        raise BadResults(f"{path}: it is truncated or no parquet file ({reason}); delete it and run again") from error
    metadata = arrow.schema.metadata or {}
    version = metadata.get(b"orientation-bench schema", b"none").decode()
    if metadata.get(b"orientation-bench table", b"").decode() != table or version != VERSION:
        raise BadResults(
            f"{path}: its schema is '{version}', this program reads '{VERSION}' of table '{table}'; run again into "
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
                raise BadResults(f"{path}: {word!r} in column {name!r} is no word of ours; delete the file")


def read(folder: Path, table: str) -> pd.DataFrame:
    """One table of a finished run as a data frame.

    Errors:
        BadResults: see `read_arrow`; also a folder whose run has not finished.
    """
    if table not in TABLES:
        raise KeyError(table)
    folder = Path(folder)
    if not folder.is_dir():
        raise BadResults(f"{folder}: there is no such folder; run `make bench` (or python -m bench run) first")
    if not (folder / "provenance.json").is_file():
        raise BadResults(f"{folder}: the run there has not finished; the same `python -m bench run` command resumes it")
    return read_arrow(folder / f"{table}.parquet", table).to_pandas(ignore_metadata=True)
