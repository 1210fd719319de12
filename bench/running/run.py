"""A plan carried out: units run by a scheduler, each written when done, so that a run killed at any moment resumes.

At the end its tables are made from the parts, in the order of the units; then provenance.json says where they are from.
"""

import contextlib
import functools
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import pyarrow as pa

from bench.base.files import write_json
from bench.base.provenance import describe
from bench.experiments.experiment import Unit, experiment_of, known_experiments
from bench.experiments.plan import Plan
from bench.experiments.request import check_workers
from bench.experiments.tables.store import lost_table, merge, read_arrow, write_table
from bench.running.precompile import compiling_ahead
from bench.running.run_folder import begin, inspect, open_run_folder, part, read_part, sweep, tidy
from bench.running.sandbox.sandbox import LOST, Sandbox
from bench.running.schedulers import THREADS, check_scheduler, kind, threads


def run(
    plan: Plan,
    out: Path,
    *,
    workers: int = 2,
    scheduler: str = THREADS,
    replace: bool = False,
    report: Callable[[Unit], None] = lambda _: None,
    law_limit_s: float | None = None,
) -> bool:
    """Carry out what is not done yet; return whether there was anything to do.

    workers: threads of this process. report: called with every unit when it is done. law_limit_s: how long a unit of
    a user's law may take; None for the rule of `sandbox.sandbox`. BadResults: the folder cannot be used, or
    another run is at work there. MissingTool, LostWorkers: a cluster. KeyboardInterrupt: after what is finished is
    written.
    """
    check_workers(workers)
    check_scheduler(scheduler)
    out = Path(out)
    with open_run_folder(out), Sandbox(plan, law_limit_s) as sandbox:
        state = inspect(plan, out, replace)
        if state.finished:
            tidy(out)
            return False
        for unit in state.spoiled:
            print(f"{part(out, unit)}: damaged, or of another run; the unit is run again", file=sys.stderr)
        began = time.time()
        sandbox.check()
        todo = [unit for unit in in_running_order(plan.units) if unit.key not in state.done]
        with _executor(todo, out, workers, scheduler, sandbox) as execute:
            if state.done:
                sweep(out)
                for unit in state.spoiled:
                    part(out, unit).unlink()
            else:
                begin(plan, out)
            for unit in plan.units:
                if unit.key in state.done:
                    report(unit)
            by = {"scheduler": kind(scheduler), "workers": execute(report), "resumed": bool(state.done)}
        _finish(plan, out, sandbox, began, by)
        return True


@contextlib.contextmanager
def _executor(todo: list[Unit], out: Path, workers: int, scheduler: str, sandbox: Sandbox) -> Iterator[Callable]:
    """Yield execute(report), which carries out the units, reports each, and returns the number of workers.

    A cluster has answered when this yields, so that nothing is written, or replaced, for one that does not.
    """
    if scheduler == THREADS:
        ours = [unit for unit in todo if experiment_of(unit).compiles and not sandbox.has(unit)]
        with compiling_ahead(sandbox.plan, ours) as ahead:
            yield functools.partial(threads.run, todo, out, workers, sandbox, ahead=ahead)
        return
    from bench.running.schedulers import cluster  # Dask is an extra, and takes a second to import

    with cluster.client_of(scheduler) as client:
        yield lambda done: cluster.Chunks(client, sandbox, out, done).carry_out(todo)


def in_running_order(units: Iterable[Unit]) -> list[Unit]:
    """Contender by contender; the first unit of each before the rest of the one before it; what compiles nothing last.

    A contender is compiled when its first unit runs, by one thread at a time: so the others have something to run.
    """
    units = list(units)
    compiling = [unit for unit in units if experiment_of(unit).compiles]
    place = {name: i for i, name in enumerate(dict.fromkeys(unit.contender for unit in compiling))}
    heads = set({unit.contender: unit for unit in reversed(compiling)}.values())
    ordered = sorted(compiling, key=lambda unit: (place[unit.contender] - (unit in heads), unit not in heads))
    return ordered + [unit for unit in units if not experiment_of(unit).compiles]


def _finish(plan: Plan, out: Path, sandbox: Sandbox, began: float, about: dict) -> None:
    """Write the tables and provenance.json; units to be tried again count as crashed, and other parts then stay."""
    notes, again = [*sandbox.notes], sandbox.again
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
            "suite": plan.request.suite,
            "plan": plan.digest,
            "episodes": plan.episodes("free-body", "arm", "map"),
            "trials": plan.episodes("contact"),
            "troubled": plan.episodes("robustness"),
            "seed": plan.request.seed,
            **about,
            "finished": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()),
            "wall_s": round(time.time() - began, 1),
            "lost": list(dict.fromkeys((*notes, *_lost_rows(plan, out)))),
            **({"again": sorted(again)} if again else {}),
        },
    )
    if not again:
        tidy(out)


def _parts(plan: Plan, out: Path, table: str, again: set[str], notes: list[str]) -> Iterator[pa.Table]:
    """Yield the rows of every unit of a table; note each unit of a user's law that has none, and should have some."""
    own = {one.name for one in plan.request.user_laws}
    for unit in plan.units:
        experiment = experiment_of(unit)
        if experiment.table.name == table:
            made = lost_table(plan.request, unit, LOST[0]) if unit.key in again else read_part(plan, out, unit)
            if unit.law in own and not made.num_rows and not experiment.is_whole(plan.request, unit, made.to_pandas()):
                notes.append(f"{unit.label}: it has no rows of {table}")
            yield made


def _lost_rows(plan: Plan, out: Path) -> Iterator[str]:
    """How many rows say that a user's law crashed or hung, whoever made them, and when."""
    own = [one.name for one in plan.request.user_laws]
    for name, table in plan.tables.items() if own else ():
        if {"regulator", "outcome"} <= set(table.names):
            made = read_arrow(out / f"{name}.parquet", table).select(["regulator", "outcome"]).to_pandas().astype(str)
            counts = made[made["regulator"].isin(own) & made["outcome"].isin(LOST)].value_counts(sort=False)
            yield from (f"{law}: {count} of its {name} {outcome}" for (law, outcome), count in counts.items())
