"""The end of a run: its tables from the parts, in the order of the units; then where they come from."""

import functools
import time
from collections.abc import Iterator
from pathlib import Path

from bench.base.files import write_json
from bench.base.provenance import describe
from bench.experiments.experiment import experiment_of, known_experiments
from bench.experiments.plan import Plan
from bench.experiments.tables.store import frame, merge, read_arrow, write_table
from bench.running.run_folder import part, tidy
from bench.running.sandbox import LOST


def finish(plan: Plan, out: Path, lost: list[str], by: dict, began: float, resumed: bool) -> None:
    """Write the tables, and provenance.json when all are there.

    Args:
        lost: what is to be said of a user's laws. by: who carried out the units, for provenance.json.
    """
    parts: dict[str, list[Path]] = {name: [] for name in plan.tables}
    for unit in plan.units:
        parts[experiment_of(unit).table.name].append(part(out, unit))
    folds = {one.table.name: one.fold for one in known_experiments().values() if one.fold}
    for name, table in plan.tables.items():
        path, fold = out / f"{name}.parquet", folds.get(name)
        if fold is None:
            merge(path, parts[name], table)
        else:
            write_table(path, functools.reduce(fold, (frame(each, table) for each in parts[name])), table)
    write_json(
        out / "provenance.json",
        {
            **describe(),
            "suite": plan.settings.suite,
            "plan": plan.digest(),
            "episodes": plan.episodes("free-body", "arm", "map"),
            "trials": plan.episodes("contact"),
            "troubled": plan.episodes("robustness"),
            "seed": plan.settings.seed,
            **by,
            "finished": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()),
            "wall_s": round(time.time() - began, 1),
            "resumed": resumed,
            "lost": [*lost, *_lost_rows(plan, out)],
        },
    )
    tidy(out)


def _lost_rows(plan: Plan, out: Path) -> Iterator[str]:
    """How many rows say that a user's law crashed or hung, whoever made them, and when."""
    own = [one.name for one in plan.settings.own]
    for name, table in plan.tables.items() if own else ():
        if {"regulator", "outcome"} <= set(table.names):
            made = read_arrow(out / f"{name}.parquet", table).select(["regulator", "outcome"]).to_pandas().astype(str)
            counts = made[made["regulator"].isin(own) & made["outcome"].isin(LOST)].value_counts(sort=False)
            yield from (f"{law}: {count} of its {name} {outcome}" for (law, outcome), count in counts.items())
