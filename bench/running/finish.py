"""The end of a run: its tables from the parts, in the order of the units; then where they come from."""

import functools
import time
from collections.abc import Iterator
from pathlib import Path

import pyarrow as pa

from bench.base.files import write_json
from bench.base.provenance import describe
from bench.experiments.experiment import experiment_of, known_experiments
from bench.experiments.plan import Plan
from bench.experiments.tables.store import lost_table, merge, read_arrow, write_table
from bench.running.run_folder import read_part, tidy
from bench.running.sandbox import LOST


def finish(plan: Plan, out: Path, lost: list[str], again: set[str], by: dict, began: float, resumed: bool) -> None:
    """Write the tables, and provenance.json when all are there.

    Args:
        lost: what is to be said of a user's laws. again: keys of the units that have no rows, for the process of their
            law was killed twice while it prepared: they count as crashed, and are tried by the next run; so the parts
            of the others stay. by: who carried out the units, for provenance.json.
    """
    notes = [*lost]
    folds = {one.table.name: one.fold for one in known_experiments().values() if one.fold}
    for name, table in plan.tables.items():
        path, fold = out / f"{name}.parquet", folds.get(name)
        parts = _parts(plan, out, name, again, notes)
        if fold is None:
            merge(path, parts, table)
        else:
            write_table(path, functools.reduce(fold, (one.to_pandas(ignore_metadata=True) for one in parts)), table)
    write_json(
        out / "provenance.json",
        {
            **describe(),
            "suite": plan.settings.suite,
            "plan": plan.digest,
            "episodes": plan.episodes("free-body", "arm", "map"),
            "trials": plan.episodes("contact"),
            "troubled": plan.episodes("robustness"),
            "seed": plan.settings.seed,
            **by,
            "finished": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()),
            "wall_s": round(time.time() - began, 1),
            "resumed": resumed,
            "lost": list(dict.fromkeys((*notes, *_lost_rows(plan, out)))),
            **({"again": sorted(again)} if again else {}),
        },
    )
    if not again:
        tidy(out)


def _parts(plan: Plan, out: Path, table: str, again: set[str], notes: list[str]) -> Iterator[pa.Table]:
    """Yield the rows of every unit of a table; note each unit of a user's law that has none, and should have some."""
    own = {one.name for one in plan.settings.own}
    for unit in plan.units:
        experiment = experiment_of(unit)
        if experiment.table.name == table:
            made = lost_table(plan.settings, unit, LOST[0]) if unit.key in again else read_part(plan, out, unit)
            if unit.law in own and not made.num_rows and not experiment.is_whole(plan.settings, unit, made.to_pandas()):
                notes.append(f"{unit.label}: it has no rows of {table}")
            yield made


def _lost_rows(plan: Plan, out: Path) -> Iterator[str]:
    """How many rows say that a user's law crashed or hung, whoever made them, and when."""
    own = [one.name for one in plan.settings.own]
    for name, table in plan.tables.items() if own else ():
        if {"regulator", "outcome"} <= set(table.names):
            made = read_arrow(out / f"{name}.parquet", table).select(["regulator", "outcome"]).to_pandas().astype(str)
            counts = made[made["regulator"].isin(own) & made["outcome"].isin(LOST)].value_counts(sort=False)
            yield from (f"{law}: {count} of its {name} {outcome}" for (law, outcome), count in counts.items())
