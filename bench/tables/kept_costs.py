"""Operations of our own laws, kept beside their compiled code (bench/engines/cache.py): the sources decide both.

Counting all laws takes ten seconds, more than a run of one law; a user's own is counted anew each time.
"""

import contextlib
from collections.abc import Callable
from pathlib import Path

from bench import counting
from bench.engines import cache
from bench.errors import BadResults
from bench.law.contender import Contender
from bench.provenance import source_digest
from bench.tables.files import read_json, write_json

Rows = list[dict]


def of_law(contender: Contender) -> Rows:
    """Rows of costs.parquet of a law alone."""
    return kept(contender, contender.name, lambda: counting.rows([contender]))


def of_controller(contender: Contender, joints: int) -> Rows:
    """Those of a controller on so many joints."""
    return kept(contender, f"{contender.name}-{joints}", lambda: counting.rows_on_arm(contender, joints))


def kept(
    contender: Contender, name: str, count: Callable[[], Rows], folder: Path = cache.FOLDER, sources: str = ""
) -> Rows:
    """What `count` found when it was first called by that name for these sources; none named: this checkout's."""
    if contender.regulator.origin:
        return count()
    path = folder / "costs" / f"{sources or source_digest()}-{name.replace('/', '_')}.json"
    if path.is_file():
        content = read_json(path)
        return [dict(zip(content["columns"], row, strict=True)) for row in content["rows"]]
    rows = count()
    with contextlib.suppress(BadResults):  # without room for it the next run counts again
        write_json(path, {"columns": list(rows[0]), "rows": [list(row.values()) for row in rows]})
    return rows
