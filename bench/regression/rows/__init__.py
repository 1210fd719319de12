"""Two runs, row by row: `differences(base, head)`, and `compare(base, head)` for the same in lines.

Schema, row keys, outcomes and operation counts must be the same exactly; a settling time to less than half a tick;
other numbers of settled episodes to RELATIVE. Numbers of an episode that failed are not compared, its cause among
them: on its way it may pass a singular point, where the last bit of a library's sine decides them.

An arm has more such points. Where it passed one it has been judged on both sides of its start (`rounding`): one
outcome of base must then be one of head, and a number the same to what it changed by.

In contact rounding decides for coordinates whose singular set the goal lies on, and for a hand that was THROWN about.

difference   what differs, and how it is said
tables       how each table is compared, with its tolerances
contact      tables of hands in contact, and of laws under perturbations
"""

from pathlib import Path

from bench.errors import BadResults
from bench.experiments.columns import Table
from bench.experiments.experiment import known_tables
from bench.files import read_json
from bench.regression.rows.contact import compliance, robustness
from bench.regression.rows.difference import COLUMN, Difference, by_column, lines
from bench.regression.rows.tables import (
    boundaries,
    command_field,
    costs,
    episodes,
    of_key,
    poses,
    traces,
    velocity,
    velocity_limits,
)
from bench.tables.store import read, read_arrow

__all__ = ["TABLES", "Difference", "compare", "differences", "lines"]

TABLES = {
    "episodes": episodes,
    "costs": costs,
    "boundaries": boundaries,
    "command-field": command_field,
    "poses": poses,
    "compliance": compliance,
    "robustness": robustness,
    "traces": traces,
    "velocity": velocity,
    "velocity-limits": velocity_limits,
}
"""What is compared in a way of its own; tables of other experiments are, row by row, as `of_key` says."""


def compare(base: Path, head: Path) -> list[str]:
    """What differs between two runs' folders, a line each; empty if nothing does.

    Errors:
        BadResults: a folder holds no finished run.
    """
    return lines(differences(base, head))


def differences(base: Path, head: Path) -> list[Difference]:
    """What differs between two runs' folders, row by row; of a table whose columns differ, only those.

    Of runs that different judges judged, how many rows by column.

    Errors:
        BadResults: a folder holds no finished run.
    """
    found: list[Difference] = []
    tables = known_tables()
    for name in (*TABLES, *(tables.keys() - TABLES.keys())):
        rows = TABLES.get(name) or of_key(tables[name])
        try:
            old, new = read(base, tables[name]), read(head, tables[name])
        except BadResults as error:
            raise BadResults(f"nothing to compare: {error}") from error
        found += _schema(tables[name], base, head) or rows(old, new)
    was, now = (read_json(Path(folder) / "provenance.json").get("judge") for folder in (base, head))
    return by_column(found) if found and was and now and was != now else found


def _schema(table: Table, base: Path, head: Path) -> list[Difference]:
    """Columns, types and units that differ."""
    was, now = (_fields(Path(folder) / f"{table.name}.parquet", table) for folder in (base, head))
    said = [(name, f"column {name} is missing") for name in was if name not in now]
    said += [(name, f"column {name} is new") for name in now if name not in was]
    for name in was:
        if name in now and now[name] != was[name]:
            said.append((name, f"column {name} is {_typed(now[name])}, was {_typed(was[name])}"))
    if not said and list(now) != list(was):
        said.append(("", "the columns come in another order"))
    return [Difference(table.name, COLUMN, name, f"{table.name}: {words}", {}) for name, words in said]


def _fields(path: Path, table: Table) -> dict[str, tuple[str, str]]:
    return {
        field.name: (str(field.type), (field.metadata or {}).get(b"unit", b"").decode())
        for field in read_arrow(path, table).schema
    }


def _typed(field: tuple[str, str]) -> str:
    return f"{field[0]} [{field[1]}]"
