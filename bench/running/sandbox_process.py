"""A user's laws in a process of their own: it compiles them once, and forks for whatever may hang, crash or exit.

`bench.running.sandbox` starts it as `python -m bench.running.sandbox_process DESCRIPTOR`. Over that descriptor comes a
chunk (wire_format.py), then one request after the other, JSON; back go bytes, the first of them a sign. A request has
a limit of processor time, which no other load on the machine shortens, and one of time for a law that waits.
"""

import functools
import json
import math
import os
import resource
import signal
import sys
import time
from collections.abc import Callable
from multiprocessing.connection import Connection, wait
from typing import NoReturn

import pyarrow as pa

from bench.errors import BenchError
from bench.experiments.experiment import Unit, experiment_of, rows_of
from bench.experiments.plan import Plan
from bench.running.wire_format import plan_of
from bench.tables.store import as_table

DONE, MISTAKE, CRASHED, HUNG = b"+", b"?", b"!", b"."
"""Signs: before what was asked for; before the message of an error that is the user's; before why a law was lost."""

READY_S = 300
"""Seconds of processor time for compiling: five times what all engines take that were never compiled before."""


def answer(work: Callable[[], bytes]) -> bytes:
    """What a request is answered with, by this process."""
    try:
        return DONE + work()
    except BenchError as error:
        return MISTAKE + str(error).encode()
    except Exception as error:
        return CRASHED + f"{type(error).__name__}: {error}".encode()


def prepared(plan: Plan, unit: Unit) -> bytes:
    """Nothing, when all is compiled, imported and built that the unit's rows need, for all forks."""
    experiment_of(unit).prepare(plan.settings, unit)
    return b""


def made(plan: Plan, unit: Unit) -> bytes:
    """The rows of a unit."""
    return packed(as_table(rows_of(plan.settings, unit), experiment_of(unit).table))


def packed(table: pa.Table) -> bytes:
    """A table as bytes."""
    sink = pa.BufferOutputStream()
    with pa.ipc.new_stream(sink, table.schema) as stream:
        stream.write_table(table)
    return sink.getvalue().to_pybytes()


def unpacked(content: bytes) -> pa.Table:
    """The table of such bytes."""
    return pa.ipc.open_stream(content).read_all()


def answer_of_a_fork(work: Callable[[], bytes], processor_s: float, longest_s: float, run_of: Connection) -> bytes:
    """The same by a fork of this process, with its limits; the end of the run is its end too.

    Args:
        run_of: the line to the run.
    """
    reading, writing = os.pipe()
    child = os.fork()
    if not child:
        _answer_and_exit(work, processor_s, writing)
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


def _answer_and_exit(work: Callable[[], bytes], processor_s: float, writing: int) -> NoReturn:
    try:
        _limit(processor_s)
        with open(writing, "wb") as pipe:
            pipe.write(answer(work))
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
        units = {unit.key: unit for unit in plan.units}
        while True:
            asked = json.loads(run_of.recv_bytes())
            unit = units[asked["key"]]
            if "processor_s" not in asked:
                _limit(READY_S)
                run_of.send_bytes(answer(functools.partial(prepared, plan, unit)))
            else:
                some = unit.part(asked["first"], asked["count"]) if "count" in asked else unit
                limits = asked["processor_s"], asked["longest_s"]
                run_of.send_bytes(answer_of_a_fork(functools.partial(made, plan, some), *limits, run_of))


if __name__ == "__main__":
    try:
        main(int(sys.argv[1]))
    except (EOFError, ConnectionError):  # the run is gone
        sys.exit(1)
