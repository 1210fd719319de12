"""The end of a run: its tables from the parts, and what is made of the plan as a whole."""

import functools
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pandas as pd

import tasks
from bench import boundary, counting, poses, traces
from bench.discovery import all_contenders
from bench.errors import BadLaw
from bench.journal import part, tidy
from bench.plan import Plan
from bench.provenance import describe
from bench.store import merge, write_json, write_table


def finish(
    plan: Plan, out: Path, own_costs: list[dict], threads: int, by: dict, began: float, resumed: bool
) -> None:
    """Write the tables, and provenance.json when all are there.

    Args:
        threads: of this process. by: who carried out the units, for provenance.json.
    """
    with ThreadPoolExecutor(threads) as pool:
        others = pool.submit(_write_all_but_boundaries, plan, out, own_costs)
        write_table(out / "boundaries.parquet", boundary.run(plan, pool), "boundaries")
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
        },
    )
    tidy(out)


def _write_all_but_boundaries(plan: Plan, out: Path, own_costs: list[dict]) -> int:
    """One table after the other, each let go before the next; the number of episodes.

    All of it holds Python's lock, so that a second thread for it would be none the faster; boundaries do not.
    """
    write_table(out / "traces.parquet", traces.run(plan), "traces")
    write_table(out / "poses.parquet", poses.run(plan), "poses")
    costs = _law_costs(plan) + own_costs + _arm_costs(plan)
    write_table(out / "costs.parquet", pd.DataFrame(costs), "costs")
    merge(out / "compliance.parquet", [part(out, unit) for unit in plan.contacts], "compliance")
    merge(out / "robustness.parquet", [part(out, unit) for unit in plan.troubles], "robustness")
    return merge(out / "episodes.parquet", [part(out, unit) for unit in plan.units], "episodes")


def _law_costs(plan: Plan) -> list[dict]:
    """Operations of every law of ours, run or not."""
    return _counted(plan, ((one, functools.partial(counting.rows, [one])) for one in all_contenders()))


def own_costs(plan: Plan) -> list[dict]:
    """Operations of a user's laws, counted first: what cannot be counted is a mistake, and nothing is written."""
    own = (one for one in plan.laws if one.regulator.origin)
    return _counted(plan, ((one, functools.partial(counting.rows, [one])) for one in own))


def _arm_costs(plan: Plan) -> list[dict]:
    """Operations of every controller that runs on an arm."""
    on_arms = dict.fromkeys((unit.contender, tasks.arm(unit.arm).joints) for unit in plan.units if unit.arm)
    pairs = ((plan.contender(name), joints) for name, joints in on_arms)
    return _counted(plan, ((one, functools.partial(counting.rows_on_arm, one, joints)) for one, joints in pairs))


def _counted(plan: Plan, jobs) -> list[dict]:
    """The rows of all jobs; none of a user's law beyond the dialect, if only `reference` runs it."""
    only_reference = all(unit.engine == "reference" for unit in plan.units)
    rows = []
    for one, count in jobs:
        try:
            rows += count()
        except BadLaw:
            if not (one.regulator.origin and only_reference):
                raise
    return rows
