"""Compare two runs row by row: `find_differences(base, head)`, and `compare(base, head)` for the same in lines.

Schema, row keys, outcomes and operation counts must be the same; a settling time to less than half a tick; other
numbers of settled episodes to RELATIVE. Numbers of a failed episode are not compared: where it passes a singular point,
the last bit of a sine decides them. An episode of an arm that passed such a point has been judged beside its
start (`rounding_change`): one outcome of base must be one of head, and a number must agree to what it changed by.
"""

from collections import Counter
from pathlib import Path

from bench.base.provenance import read_provenance
from bench.experiments.columns import Table
from bench.experiments.experiment import known_tables
from bench.experiments.tables.store import find_newer, read, read_arrow
from bench.regression.rows.difference import COLUMN, JUDGE, NAMES, NEW, Difference, write_lines
from bench.regression.rows.tables import RULES, compare_tables


def compare(base: Path, head: Path) -> list[str]:
    """Return what differs between two runs' folders, a line each, without rows of names that base has nowhere."""
    return write_lines(_drop_additions(find_differences(base, head), base))


def _drop_additions(differences: list[Difference], base: Path) -> list[Difference]:
    """Leave out new rows of a law, a perturbation or an arm that base has nowhere."""
    frames = [read(base, one) for one in known_tables().values()]
    known = {word for rows in frames for name in NAMES & {*rows.columns} for word in rows[name].astype(str)} | {""}
    return [one for one in differences if one.kind != NEW or {one.row.get(name, "") for name in NAMES} <= known]


def describe_skipped(base: Path) -> list[str]:
    """Return a sentence for each table that is not compared."""
    return [f"{name}: not compared, because the experiment is newer than the run in base" for name in find_newer(base)]


def find_differences(base: Path, head: Path) -> list[Difference]:
    """Return what differs between two folders of finished runs, row by row; of two judges, only counts by column."""
    found: list[Difference] = []
    tables, newer = known_tables(), find_newer(base)
    for name in (one for one in dict.fromkeys((*RULES, *tables)) if one not in newer):
        old, new = read(base, tables[name]), read(head, tables[name])
        found += _compare_columns(tables[name], base, head) or compare_tables(tables[name], old, new)
    was, now = (read_provenance(Path(folder)).get("judge") for folder in (base, head))
    kept = _drop_additions(found, base) if was and now and was != now else []
    if not kept:
        return found
    counts = Counter((one.table, one.column or f"rows {one.kind}") for one in kept)
    said = [f"{table}: {column}: {count}" for (table, column), count in counts.items()]
    first = f"the judge changed: {len(kept)} differences, by column; laws are not compared"
    return [Difference(line.partition(":")[0], JUDGE, line, line, {}) for line in (first, *said)]


def _compare_columns(table: Table, base: Path, head: Path) -> list[Difference]:
    """Return columns, types and units that differ."""
    schemas = (read_arrow(Path(folder) / f"{table.name}.parquet", table).schema for folder in (base, head))
    was, now = ([f"{one.name} {one.type} {(one.metadata or {}).get(b'unit')!r}" for one in each] for each in schemas)
    words = [f"{table.name}: column {name} is missing" for name in was if name not in now]
    words += [f"{table.name}: column {name} is new" for name in now if name not in was]
    if not words and was != now:
        words = [f"{table.name}: the columns come in another order"]
    return [Difference(table.name, COLUMN, one, one, {}) for one in words]
