"""A user's laws in a process of their own: it compiles them once, and forks for whatever may hang, crash or exit.

`bench.running.sandbox` starts it as `python -m bench.running.sandbox_process DESCRIPTOR`. Over that descriptor comes a
chunk (wire_format.py), then one request after the other, JSON; back go bytes, the first of them a sign. A request has
a limit of processor time, which no other load on the machine shortens, and one of time for a law that waits.
"""

import dataclasses
import importlib
import json
import math
import os
import resource
import signal
import sys
import time
from multiprocessing.connection import Connection, wait
from typing import NoReturn

import pyarrow as pa

import tasks
from bench import counting
from bench.engines import run, run_arm
from bench.errors import BenchError
from bench.experiments import boundary, traces
from bench.experiments.plan import AnyUnit, Plan, Unit
from bench.experiments.work import rows, starts_of
from bench.metrics.registry import metrics_of
from bench.running.wire_format import plan_of
from bench.tables.store import as_table

DONE, MISTAKE, CRASHED, HUNG = b"+", b"?", b"!", b"."
"""Signs: before what was asked for; before the message of an error that is the user's; before why a law was lost."""

READY_S = 300
"""Seconds of processor time for compiling: five times what all engines take that were never compiled before."""

TABLES = ("traces", "boundaries")


def answer(plan: Plan, asked: dict) -> bytes:
    """What a request is answered with, by this process.

    Args:
        asked: `what`, one of ready, rows, costs and TABLES; for the first two a unit's `key`, and the `first` and
        `count` of its episodes that are meant; for the others a `contender`.
    """
    try:
        return DONE + _answer(plan, **asked)
    except BenchError as error:
        return MISTAKE + str(error).encode()
    except Exception as error:
        return CRASHED + f"{type(error).__name__}: {error}".encode()


def _answer(plan: Plan, what: str, key: str = "", first: int = 0, count: int = 0, contender: str = "") -> bytes:
    if what in TABLES:
        return packed(_made_of(_alone(plan, contender), what))
    if what == "costs":
        return json.dumps(_costs(plan, contender)).encode()
    unit = next(one for one in plan.work if one.key == key)
    if what == "ready":
        _prepare(plan, unit)
        return b""
    some = dataclasses.replace(unit, first=first, count=count) if isinstance(unit, Unit) else unit
    return packed(as_table(rows(plan, some), some.table))


def _prepare(plan: Plan, unit: AnyUnit) -> None:
    """Compile, import and build what the unit's rows need, for all forks."""
    one = plan.contender(unit.contender)
    metrics = tuple(metrics_of(on_arm=one.is_on_arm))
    if isinstance(unit, Unit):
        starts_of(plan, unit)
    if not isinstance(unit, Unit):
        run.evaluation(one)
    elif unit.engine == "reference":
        importlib.import_module("tasks.episode")
    elif one.is_on_arm:
        run_arm.compiled_loop(metrics)
        run_arm.pointers(one)
    else:
        run.compiled_loop(unit.engine, metrics)
        run.evaluation(one)


def _alone(plan: Plan, contender: str) -> Plan:
    """The plan of one contender."""
    units = tuple(unit for unit in plan.units if unit.contender == contender)
    return dataclasses.replace(plan, contenders=(plan.contender(contender),), units=units)


def _costs(plan: Plan, contender: str) -> list[dict]:
    """Operations of a law, or of its controller on every number of joints that it is run with."""
    one = plan.contender(contender)
    if not one.is_on_arm:
        return counting.rows([one])
    joints = dict.fromkeys(tasks.arm(unit.arm).joints for unit in plan.units if unit.contender == contender)
    return [row for n in joints for row in counting.rows_on_arm(one, n)]


def _made_of(plan: Plan, table: str) -> pa.Table:
    return traces.run(plan) if table == "traces" else as_table(boundary.run(plan), table)


def packed(table: pa.Table) -> bytes:
    """A table as bytes."""
    sink = pa.BufferOutputStream()
    with pa.ipc.new_stream(sink, table.schema) as stream:
        stream.write_table(table)
    return sink.getvalue().to_pybytes()


def unpacked(content: bytes) -> pa.Table:
    """The table of such bytes."""
    return pa.ipc.open_stream(content).read_all()


def answer_of_a_fork(plan: Plan, asked: dict, processor_s: float, longest_s: float, run_of: Connection) -> bytes:
    """The same by a fork of this process, with its limits; the end of the run is its end too.

    Args:
        run_of: the line to the run.
    """
    reading, writing = os.pipe()
    child = os.fork()
    if not child:
        _answer_and_exit(plan, asked, processor_s, writing)
    os.close(writing)
    said, deadline = [b" "], time.monotonic() + longest_s
    while said[-1] and (ready := wait([reading, run_of], max(0.0, deadline - time.monotonic()))):
        if run_of in ready:
            os.kill(child, signal.SIGKILL)
            raise EOFError  # the run says nothing before it has its answer, so that this is its end
        said.append(os.read(reading, 1 << 20))
    os.close(reading)
    if said[-1]:
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        return HUNG + f"it did not return within {longest_s:.3g} s".encode()
    code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if code == 0:
        return b"".join(said[1:])
    if code == -signal.SIGXCPU:
        return HUNG + f"it did not return within {processor_s:.3g} s of processor time".encode()
    ending = f"exit code {code}" if code > 0 else signal.Signals(-code).name
    return CRASHED + f"it ended its process ({ending})".encode()


def _answer_and_exit(plan: Plan, asked: dict, processor_s: float, writing: int) -> NoReturn:
    try:
        _limit(processor_s)
        with open(writing, "wb") as pipe:
            pipe.write(answer(plan, asked))
        os._exit(0)
    finally:
        os._exit(1)  # what is no Exception, as sys.exit: the law wants to leave


def _limit(processor_s: float) -> None:
    """End this process with SIGXCPU when it has used so many seconds more, rounded up."""
    used = resource.getrusage(resource.RUSAGE_SELF)
    _, most = resource.getrlimit(resource.RLIMIT_CPU)
    resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(used.ru_utime + used.ru_stime + processor_s), most))


def main(descriptor: int) -> None:
    """Answer until the run lets go."""
    with Connection(descriptor) as run_of:
        try:
            _limit(READY_S)
            plan = plan_of(json.loads(run_of.recv_bytes()))
        except BenchError as error:
            run_of.send_bytes(MISTAKE + str(error).encode())
            return
        run_of.send_bytes(DONE)
        while True:
            asked = json.loads(run_of.recv_bytes())
            if asked["what"] == "ready":
                _limit(READY_S)
                run_of.send_bytes(answer(plan, asked))
            else:
                limits = asked.pop("processor_s"), asked.pop("longest_s")
                run_of.send_bytes(answer_of_a_fork(plan, asked, *limits, run_of))


if __name__ == "__main__":
    try:
        main(int(sys.argv[1]))
    except (EOFError, ConnectionError):  # the run is gone
        sys.exit(1)
