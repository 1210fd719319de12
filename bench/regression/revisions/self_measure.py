"""A checkout's own measurements alone, as a history keeps them: `self_measure.measure()`."""

from collections.abc import Callable
from typing import Any, NamedTuple

import pandas as pd

from bench import counting
from bench.contenders.registry import all_contenders
from bench.errors import MissingTool
from bench.experiments.costs import count_law
from bench.files import read_json
from bench.provenance import ROOT, commit, cpu_name, describe, lock_digest, machine_key, source_digest, versions
from bench.regression.revisions import alternating, instructions
from bench.regression.revisions.machine import target
from bench.regression.revisions.measurement import Measurement
from bench.regression.revisions.process import Laws, Process, running
from bench.tables.read import with_contender
from bench.tables.schema import RESULTS
from bench.tables.store import read

RUNS = (RESULTS / "quick", RESULTS / "reference")
"""Where operations may have been counted already."""

Operations = dict[str, dict[str, dict[str, int]]]
"""Law -> branch -> operation -> how many a tick."""


class SelfMeasure(NamedTuple):
    """All benchmarks of one checkout on this machine.

    commit: "" outside git. dirty: whether its sources had changes. machine: `machine()`. uncounted: why there are no
    instructions; empty if there are.
    """

    commit: str
    dirty: bool
    sources: str
    machine: dict[str, Any]
    measurements: tuple[Measurement, ...]
    uncounted: str = ""


def machine() -> dict[str, Any]:
    """Where something is measured: what must be the same for times to be compared, and for instructions."""
    return {
        "key": machine_key(),
        "cpu": cpu_name(),
        "cores": describe()["cores"],
        "platform": describe()["platform"],
        "lock": lock_digest(),
        "versions": versions(),
        "target": target(),
    }


def measure(report: Callable[[str], None] = lambda _: None, rounds: int = alternating.ROUNDS) -> SelfMeasure:
    """Compile, count and time every law and engine of this checkout.

    Args:
        report: called with a few words at every step.
    """
    report("compiling")
    with running([(ROOT, Laws())]) as [side]:
        report("counting instructions")
        try:
            counted, why = instructions.count(side, timed_laws(side)), ""
        except MissingTool as error:
            counted, why = {}, str(error)
        [rounds_of] = alternating.take([side], timed(side), rounds, report=report)
        report("counting operations")
        found = measurements(side, counted, rounds_of, operations())
    at = commit()
    return SelfMeasure(at["commit"], at["dirty"], side.sources, machine(), tuple(found.values()), why)


def timed(side: Process) -> list[str]:
    """Names of what a side can time."""
    return [name for name, one in side.benchmarks.items() if one.ticks]


def timed_laws(side: Process) -> list[str]:
    """Of them, the laws alone."""
    return [name for name in timed(side) if side.benchmarks[name].what == "law"]


def measurements(
    side: Process, counted: dict[str, float], rounds_of: dict[str, alternating.Rounds], operations_of: Operations
) -> dict[str, Measurement]:
    """A side's measurements by name, of as much as was measured."""
    found = {}
    for name, one in side.benchmarks.items():
        taken = rounds_of.get(name)
        found[name] = Measurement(
            name,
            one.what,
            taken.kernel_steps() if taken else None,
            len(taken.ticks) if taken else 0,
            counted.get(name),
            operations_of.get(name, {}) if one.what == "law" else {},
            one.code,
        )
    return found


def operations() -> Operations:
    """Operations of every law of this checkout: from its last run if the sources are the same, else counted."""
    for folder in RUNS:
        origin = folder / "provenance.json"
        if origin.is_file() and read_json(origin)["sources"] == source_digest():
            return by_law(read(folder, "costs"))
    return by_law(pd.DataFrame([row for one in all_contenders() for row in count_law(one)]))


def by_law(costs: pd.DataFrame) -> Operations:
    """Operations a tick of laws alone, from rows of costs.parquet."""
    rows = with_contender(costs[(costs["jacobian"] == "") & (costs["stage"] == counting.TOTAL)])
    found: Operations = {}
    for row in rows.to_dict("records"):
        numbers = {name: int(row[name]) for name in (*counting.OPERATIONS, "flops")}
        found.setdefault(str(row["contender"]), {})[str(row["branch"])] = numbers
    return found
