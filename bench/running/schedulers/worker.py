"""What a worker of a cluster does: a chunk's text in, its rows as parquet out. It knows nothing of Dask."""

import importlib
import json
import signal

import pyarrow as pa
import pyarrow.parquet as pq

from bench.experiments.experiment import Unit, experiment_of, rows_of
from bench.experiments.plan import Plan
from bench.experiments.tables.store import as_table, encoding
from bench.running.sandbox import Sandbox
from bench.running.wire_format import plan_of


def carry_out(text: str, law_limit_s: float | None = None) -> tuple[dict[str, bytes], list[str]]:
    """Key -> file of its rows of every unit of a chunk, and what is to be said of a user's laws.

    Args:
        text: what `wire_format.described` says of it, as JSON. law_limit_s: of a user's law, as `bench.running.sandbox`
            takes it.
    Errors:
        BadResults: this worker has other sources. BadLaw: a user's law that it cannot load.
    """
    plan = plan_of(json.loads(text))
    with Sandbox(plan, law_limit_s) as sandbox:
        return {unit.key: _file(_rows(plan, unit, sandbox)) for unit in plan.units}, sandbox.notes


def _rows(plan: Plan, unit: Unit, sandbox: Sandbox) -> pa.Table:
    return (
        sandbox.rows(unit) if sandbox.has(unit) else as_table(rows_of(plan.settings, unit), experiment_of(unit).table)
    )


def _file(table: pa.Table) -> bytes:
    sink = pa.BufferOutputStream()
    pq.write_table(table, sink, **encoding(table.schema))
    return sink.getvalue().to_pybytes()


def dask_setup(_: object) -> None:
    """Prepare the main thread of a worker that begins (--preload bench.running.schedulers.worker).

    Ctrl-C is the client's to answer, though a terminal sends it to all; and GLFW can be silenced in this thread only.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    importlib.import_module("tasks.episode")
