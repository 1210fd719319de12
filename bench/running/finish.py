"""The end of a run: its tables from the parts, and what is made of the plan as a whole."""

import dataclasses
import time
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

import pandas as pd
import pyarrow as pa

import tasks
from bench.contenders.registry import all_contenders
from bench.experiments import boundary, poses, traces
from bench.experiments.plan import Plan
from bench.provenance import describe
from bench.running import sandbox_process
from bench.running.run_folder import part, tidy
from bench.running.sandbox import Guard
from bench.tables import kept_costs
from bench.tables.store import as_table, joined, merge, write_json, write_table


def finish(plan: Plan, out: Path, guard: Guard, threads: int, by: dict, began: float, resumed: bool) -> None:
    """Write the tables, and provenance.json when all are there; of a user's laws what `guard` has of them.

    Args:
        threads: of this process. by: who carried out the units, for provenance.json.
    """
    ours = _ours(plan)
    with ThreadPoolExecutor(threads) as pool:
        own = pool.submit(_own, guard)
        others = pool.submit(_write_all_but_boundaries, plan, ours, out, own)
        boundaries = as_table(boundary.run(ours, pool), "boundaries")
        write_table(out / "boundaries.parquet", _with(boundaries, own.result()["boundaries"]), "boundaries")
        rows = others.result()
    write_json(
        out / "provenance.json",
        {
            **describe(),
            "suite": plan.suite,
            "plan": plan.digest(),
            "episodes": rows,
            "trials": plan.trials,
            "troubled": plan.troubled,
            "seed": plan.seed,
            **by,
            "finished": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()),
            "wall_s": round(time.time() - began, 1),
            "resumed": resumed,
            "lost": guard.notes,
        },
    )
    tidy(out)


def _ours(plan: Plan) -> Plan:
    """The plan without a user's laws."""
    contenders = tuple(one for one in plan.contenders if not one.regulator.origin)
    names = {one.name for one in contenders}
    return dataclasses.replace(
        plan, contenders=contenders, units=tuple(unit for unit in plan.units if unit.contender in names)
    )


def _own(guard: Guard) -> dict:
    """What is made of a user's laws as wholes."""
    return {"costs": guard.costs(), **{table: guard.tables(table) for table in sandbox_process.TABLES}}


def _with(ours: pa.Table, own: list[pa.Table]) -> pa.Table:
    """A table of ours, and below it what there is of a user's laws."""
    return joined([ours, *own]) if own else ours


def _write_all_but_boundaries(plan: Plan, ours: Plan, out: Path, own: Future) -> int:
    """One table after the other, each let go before the next; the number of episodes.

    All of it holds Python's lock, so that a second thread for it would be none the faster; boundaries do not.
    """
    write_table(out / "traces.parquet", _with(traces.run(ours), own.result()["traces"]), "traces")
    write_table(out / "poses.parquet", poses.run(plan), "poses")
    costs = _law_costs() + _arm_costs(ours) + own.result()["costs"]
    write_table(out / "costs.parquet", pd.DataFrame(costs), "costs")
    merge(out / "compliance.parquet", [part(out, unit) for unit in plan.contacts], "compliance")
    merge(out / "robustness.parquet", [part(out, unit) for unit in plan.troubles], "robustness")
    return merge(out / "episodes.parquet", [part(out, unit) for unit in plan.units], "episodes")


def _law_costs() -> list[dict]:
    """Operations of every law of ours, run or not."""
    return [row for one in all_contenders() for row in kept_costs.of_law(one)]


def _arm_costs(plan: Plan) -> list[dict]:
    """Operations of every controller that runs on an arm."""
    on_arms = dict.fromkeys((unit.contender, tasks.arm(unit.arm).joints) for unit in plan.units if unit.arm)
    return [row for name, joints in on_arms for row in kept_costs.of_controller(plan.contender(name), joints)]
