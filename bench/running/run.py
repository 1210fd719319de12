"""A plan carried out: units run by a scheduler, each written when done, so that a run killed at any moment resumes."""

import contextlib
import functools
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

from bench.experiments.choice import check_workers
from bench.experiments.experiment import Unit, experiment_of
from bench.experiments.plan import Plan
from bench.running.finish import finish
from bench.running.precompile import compiling_ahead
from bench.running.run_folder import begin, held, inspect, part, sweep, tidy
from bench.running.sandbox import Sandbox
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
    """Carry out what is not done yet; whether there was anything to do.

    Args:
        workers: threads of this process. scheduler: who carries out the units (bench/running/schedulers/__init__.py).
        report: called with every unit when it is done. law_limit_s: how long a unit of a user's law may take; None for
            the rule of `bench.running.sandbox`.
    Errors:
        BadNumber: workers. BadResults: the folder cannot be used or written, or another run is at work there.
        MissingTool, LostWorkers: a cluster. KeyboardInterrupt: after what is finished is written.
    """
    check_workers(workers)
    check_scheduler(scheduler)
    out = Path(out)
    with held(out), Sandbox(plan, law_limit_s) as sandbox:
        state = inspect(plan, out, replace)
        if state.finished:
            tidy(out)
            return False
        for unit in state.spoiled:
            print(f"{part(out, unit)}: damaged, or of another run; the unit is run again", file=sys.stderr)
        began = time.time()
        sandbox.check()
        todo = [unit for unit in in_running_order(plan.units) if unit.key not in state.done]
        with _team(plan, todo, out, workers, scheduler, sandbox) as carry_out:
            if state.done:
                sweep(out)
                for unit in state.spoiled:
                    part(out, unit).unlink()
            else:
                begin(plan, out)
            for unit in plan.units:
                if unit.key in state.done:
                    report(unit)
            by = {"scheduler": kind(scheduler), "workers": carry_out(report)}
        finish(plan, out, sandbox.notes, sandbox.again, by, began, resumed=bool(state.done))
        return True


@contextlib.contextmanager
def _team(
    plan: Plan, todo: list[Unit], out: Path, workers: int, scheduler: str, sandbox: Sandbox
) -> Iterator[Callable]:
    """Return what carries out the units, reports each to its argument, and returns its number of workers.

    A cluster has answered when this yields, so that nothing is written, or replaced, for one that does not.
    """
    if scheduler == THREADS:
        ours = [unit for unit in todo if experiment_of(unit).compiles and not sandbox.has(unit)]
        with compiling_ahead(plan, ours) as ahead:
            yield functools.partial(threads.run, plan, todo, out, workers, sandbox, ahead=ahead)
        return
    from bench.running.schedulers import cluster  # Dask is an extra, and takes a second to import

    chunks = functools.partial(cluster.Chunks, notes=sandbox.notes, again=sandbox.again)
    with cluster.client_of(scheduler) as client:
        yield lambda done: chunks(client, plan, out, done, sandbox.limit_s).carry_out(todo)


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
