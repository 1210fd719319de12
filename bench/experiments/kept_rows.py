"""Rows that the sources alone decide, kept beside compiled code (bench/engines/cache.py): made once for all runs."""

import contextlib
from collections.abc import Callable
from pathlib import Path

from bench.base.errors import BadResults
from bench.base.files import read_json, write_json
from bench.base.processes import RUNS_A_LAW
from bench.base.provenance import source_digest
from bench.engines import cache

Rows = list[dict]


def kept(name: str, make: Callable[[], Rows], folder: Path = cache.FOLDER, sources: str = "") -> Rows:
    """Return what `make` first gave by this name (kind/name) for these sources, or else for this checkout's.

    All its rows have the same columns, of numbers, words, or lists of them.
    """
    kind, _, one = name.partition("/")
    path = folder / kind / f"{sources or source_digest()}-{one.replace('/', '_')}.json"
    if path.is_file():
        content = read_json(path)
        return [dict(zip(content["columns"], row, strict=True)) for row in content["rows"]]
    rows = make()
    if RUNS_A_LAW:
        return rows  # made beside a law that may have changed what makes them
    with contextlib.suppress(BadResults):  # without room for it the next run makes them again
        if rows:
            write_json(path, {"columns": list(rows[0]), "rows": [list(row.values()) for row in rows]})
    return rows
