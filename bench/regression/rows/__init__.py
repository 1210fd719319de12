"""Compare two runs row by row: `find_differences(base, head)`, and `compare(base, head)` for the same in lines.

Schema, row keys, outcomes and operation counts must be the same; a settling time to less than half a tick; other
numbers of settled episodes to RELATIVE. Numbers of a failed episode are not compared: where it passes a singular point,
the last bit of a sine decides them. An episode of an arm that passed such a point has been judged on both sides of its
start (`rounding_change`): one outcome of base must be one of head, and a number must agree to what it changed by.
"""

from collections import Counter
from pathlib import Path

import pandas as pd

from bench.base.files import read_json
from bench.experiments.columns import Table
from bench.experiments.experiment import known_tables
from bench.experiments.tables.store import read, read_arrow
from bench.regression.rows.difference import COLUMN, JUDGE, Difference, Rule, align_rows, compare_cells, write_lines
from bench.regression.rows.tables import RELATIVE, RULES, is_settled, within


def compare(base: Path, head: Path) -> list[str]:
    """Return what differs between two runs' folders, a line each, without rows of names that base has nowhere."""
    return write_lines(find_differences(base, head), [read(base, one) for one in known_tables().values()])


def find_differences(base: Path, head: Path) -> list[Difference]:
    """Return what differs between two folders of finished runs, row by row; of two judges, only counts by column."""
    found: list[Difference] = []
    tables = known_tables()
    for name in (*RULES, *(tables.keys() - RULES.keys())):
        old, new = read(base, tables[name]), read(head, tables[name])
        found += _compare_columns(tables[name], base, head) or compare_tables(tables[name], old, new)
    was, now = (read_json(Path(folder) / "provenance.json").get("judge") for folder in (base, head))
    if not (found and was and now and was != now):
        return found
    counts = Counter((one.table, one.column or f"rows {one.kind}") for one in found)
    said = [f"{table}: {column}: {count}" for (table, column), count in counts.items()]
    first = f"the judge changed: {len(found)} differences, by column; laws are not compared"
    return [Difference(line.partition(":")[0], JUDGE, line, line, {}) for line in (first, *said)]


def compare_tables(table: Table, old: pd.DataFrame, new: pd.DataFrame) -> list[Difference]:
    """Return what differs between base's and head's rows."""
    if table.name == "traces":  # curves that came to the goal; on the others rounding may decide when they end
        old, new = (frame[is_settled(frame)] for frame in (old, new))
    old, new, found = align_rows(table, old, new)
    rule = RULES[table.name](old, new) if table.name in RULES else Rule(within(RELATIVE))
    return found + compare_cells(table, old, new, rule)


def _compare_columns(table: Table, base: Path, head: Path) -> list[Difference]:
    """Return columns, types and units that differ."""
    schemas = (read_arrow(Path(folder) / f"{table.name}.parquet", table).schema for folder in (base, head))
    was, now = ([f"{one.name} {one.type} {(one.metadata or {}).get(b'unit')!r}" for one in each] for each in schemas)
    words = [f"{table.name}: column {name} is missing" for name in was if name not in now]
    words += [f"{table.name}: column {name} is new" for name in now if name not in was]
    if not words and was != now:
        words = [f"{table.name}: the columns come in another order"]
    return [Difference(table.name, COLUMN, one, one, {}) for one in words]
