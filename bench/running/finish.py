"""The end of a run: its tables from the parts, in the order of the units; then where they come from."""

import time
from pathlib import Path

from bench.experiments.experiment import experiment_of, known_tables
from bench.experiments.plan import Plan
from bench.provenance import describe
from bench.running.run_folder import part, tidy
from bench.tables.files import write_json
from bench.tables.store import merge


def finish(plan: Plan, out: Path, lost: list[str], by: dict, began: float, resumed: bool) -> None:
    """Write the tables, and provenance.json when all are there.

    Args:
        lost: what is to be said of a user's laws. by: who carried out the units, for provenance.json.
    """
    parts: dict[str, list[Path]] = {name: [] for name in known_tables()}
    for unit in plan.units:
        parts[experiment_of(unit).table.name].append(part(out, unit))
    for name, table in known_tables().items():
        merge(out / f"{name}.parquet", parts[name], table)
    write_json(
        out / "provenance.json",
        {
            **describe(),
            "suite": plan.settings.suite,
            "plan": plan.digest(),
            "episodes": plan.episodes("free-body", "arm"),
            "trials": plan.episodes("contact"),
            "troubled": plan.episodes("robustness"),
            "seed": plan.settings.seed,
            **by,
            "finished": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()),
            "wall_s": round(time.time() - began, 1),
            "resumed": resumed,
            "lost": lost,
        },
    )
    tidy(out)
