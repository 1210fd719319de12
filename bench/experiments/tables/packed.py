"""Rows as bytes: what the process of a user's law answers, a worker sends, and a run keeps of each unit until its end.

Four bytes say how long the heading is: JSON with the table, its version, the number of rows and the words of each
column of words. Behind it, compressed, come the columns one after the other, each row a fixed number of bytes: a
number, or the place of a word. A reader therefore knows from the heading how much it will unpack.

Limitations: a null among whole numbers or words is refused, and a number that is NaN comes back as null.
"""

import json
import struct

import numpy as np
import pyarrow as pa

from bench.base.errors import BadResults
from bench.experiments.columns import COUNT, NUMBER, SINGLE, VERSION, WORD, Table
from bench.experiments.tables.store import LONGEST_WORD, PLAIN

CODEC, LENGTH = "lz4", struct.Struct("<I")
KINDS: dict[str, np.dtype] = {
    NUMBER: np.dtype("<f8"),
    SINGLE: np.dtype("<f4"),
    COUNT: np.dtype("<i8"),
    WORD: np.dtype("<i4"),
}
"""Types of columns -> what a row of one is in bytes; of a word, its place among the words of the column."""

HEADING = 1 << 16
"""Bytes of a heading without words."""


def pack(rows: pa.Table, table: Table) -> bytes:
    """Return rows of a table as bytes; ValueError if a word or a whole number is null."""
    words, columns = {}, []
    for one, column in zip(table.columns(), rows.columns, strict=True):
        if one.type in (WORD, COUNT) and column.null_count:
            raise ValueError(f"column {one.name!r} has a row without a {'word' if one.type == WORD else 'number'}")
        if one.type == WORD:  # only words that occur, in the order in which they do
            coded = column.cast(pa.string()).combine_chunks().dictionary_encode()
            words[one.name], column = coded.dictionary.to_pylist(), pa.chunked_array([coded.indices])
        columns.append(column.to_numpy().astype(KINDS[one.type]).tobytes())
    raw = b"".join(columns)
    heading = {"table": table.name, "version": VERSION, "rows": rows.num_rows, "words": words}
    text = json.dumps(heading).encode()
    return LENGTH.pack(len(text)) + text + (pa.compress(raw, CODEC, asbytes=True) if raw else b"")


def unpack(content: bytes, table: Table, most_rows: int | None = None) -> pa.Table:
    """Return the rows of such bytes; BadResults if not this table's, with a bad word, or more than most_rows."""
    try:
        return _unpacked(content, table, most_rows)
    except (ValueError, KeyError, TypeError, struct.error, RecursionError, OSError, pa.ArrowException) as error:
        raise BadResults(f"these are no rows of the table '{table.name}' ({error}); run again") from error


def most_bytes(table: Table, most_rows: int) -> int:
    """Return how many bytes so many rows take at most."""
    a_row = sum(KINDS[one.type].itemsize + (LONGEST_WORD + 4) * (one.type == WORD) for one in table.columns())
    return HEADING + 2 * most_rows * a_row


def _unpacked(content: bytes, table: Table, most_rows: int | None) -> pa.Table:
    (length,) = LENGTH.unpack_from(content)
    heading = json.loads(content[LENGTH.size : LENGTH.size + length])
    said = (heading["table"], heading["version"])
    if said != (table.name, VERSION):
        raise ValueError(f"it says that it is the table {said}, and should be {(table.name, VERSION)}")
    count, columns = heading["rows"], table.columns()
    if type(count) is not int or count < 0 or (most_rows is not None and count > most_rows):
        raise ValueError(f"it says that it has {count} rows; allowed are up to {most_rows}")
    sizes = [count * KINDS[one.type].itemsize for one in columns]
    packed, raw = content[LENGTH.size + length :], b""
    if count:
        raw = pa.decompress(packed, sum(sizes), CODEC, asbytes=True)
    if len(raw) != sum(sizes) or bool(packed) != bool(count):
        raise ValueError(f"it has {len(raw)} bytes, and {sum(sizes)} are needed")
    arrays, at = [], 0
    for one, size in zip(columns, sizes, strict=True):
        numbers = np.frombuffer(raw, KINDS[one.type], count, at)
        at += size
        is_word = one.type == WORD
        arrays.append(_words(numbers, heading["words"][one.name]) if is_word else pa.array(numbers, from_pandas=True))
    return pa.Table.from_arrays(arrays, schema=table.schema())


def _words(places: np.ndarray, words: list[str]) -> pa.Array:
    if not all(isinstance(word, str) and PLAIN.fullmatch(word) for word in words):
        raise ValueError("one of its words holds signs that no word of ours has")
    if len(set(words)) != len(words) or not np.array_equal(np.unique(places), np.arange(len(words))):
        raise ValueError("its words are not those of its rows")
    return pa.DictionaryArray.from_arrays(pa.array(places), pa.array(words, pa.string()))
