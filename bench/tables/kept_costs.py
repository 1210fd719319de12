"""Operations of our own laws, kept beside their compiled code (bench/engines/cache.py): the sources decide both.

Counting all laws takes ten seconds, more than a run of one law; a user's own is counted anew each time.
"""

import contextlib
from collections.abc import Callable

from bench import counting
from bench.engines import cache
from bench.errors import BadResults
from bench.law.contender import Contender
from bench.provenance import source_digest
from bench.tables.store import read_json, write_json

Rows = list[dict]


def of_law(contender: Contender) -> Rows:
    """Rows of costs.parquet of a law alone."""
    return _kept(contender, contender.name, lambda: counting.rows([contender]))


def of_controller(contender: Contender, joints: int) -> Rows:
    """Those of a controller on so many joints."""
    return _kept(contender, f"{contender.name}-{joints}", lambda: counting.rows_on_arm(contender, joints))


def _kept(contender: Contender, name: str, count: Callable[[], Rows]) -> Rows:
    """What `count` found for these sources the first time it was called under that name."""
    if contender.regulator.origin:
        return count()
    path = cache.FOLDER / "costs" / f"{source_digest()}-{name.replace('/', '_')}.json"
    if path.is_file():
        content = read_json(path)
        return [dict(zip(content["columns"], row, strict=True)) for row in content["rows"]]
    rows = count()
    with contextlib.suppress(BadResults):  # without room for it the next run counts again
        write_json(path, {"columns": list(rows[0]), "rows": [list(row.values()) for row in rows]})
    return rows
