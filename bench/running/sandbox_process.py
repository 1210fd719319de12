"""A user's laws in a process of their own: it compiles them once, and forks for whatever may hang, crash or exit.

`bench.running.sandbox` starts it with a DESCRIPTOR. Over that descriptor comes a chunk (wire_format.py), then one
request after the other, JSON; back go bytes, the first of them a sign. A request has a limit of processor time, which
no other load on the machine shortens, and one of time for a law that waits.
"""

import functools
import json
import os
import signal
import sys
import time
from collections.abc import Callable
from multiprocessing.connection import Connection, wait
from typing import NoReturn

from bench.base.errors import BadLaw, BenchError
from bench.experiments.experiment import Unit, experiment_of
from bench.experiments.plan import Plan
from bench.experiments.tables.packed import pack
from bench.experiments.tables.store import table_of_unit
from bench.law.contenders.described_law import TRIAL_S, TRIAL_WAITS_S
from bench.law.contenders.law_file import load_law, trial_error
from bench.law.contenders.law_process import LOOK_S, ending, limit
from bench.running.wire_format import plan_of

DONE, MISTAKE, CRASHED, HUNG = b"+", b"?", b"!", b"."
"""Signs: before what was asked for; before the message of an error that is the user's; before why a law was lost."""

COMPLETE = b"\n"
"""The last byte of a fork's answer: without it the law has ended the fork."""

ENDING_S = 0.5
"""Grace period for a fork that has sent its last message, so that its exit code is its own."""

READY_S = 120
"""Seconds of processor time for compiling: twice what all engines take that were never compiled before."""


def answer(work: Callable[[], bytes]) -> bytes:
    """Return what a request is answered with, by this process."""
    try:
        return DONE + work()
    except BenchError as error:
        return MISTAKE + str(error).encode()
    except Exception as error:
        return CRASHED + f"{type(error).__name__}: {error}".encode()


def prepared(plan: Plan, unit: Unit, run_of: Connection) -> bytes:
    """Return the answer when all that the unit's rows need is built; a law that always raises, or hangs, is lost."""

    def ready() -> bytes:
        experiment_of(unit).prepare(plan.request, unit)
        return b""

    def tried() -> bytes:
        if raised := trial_error(plan.request.contender(unit.contender)):
            raise RuntimeError(raised)
        return b""

    said = answer(ready)
    if said.startswith(MISTAKE):
        of_trial = answer_of_a_fork(tried, TRIAL_S, TRIAL_WAITS_S, run_of)
        return said if of_trial.startswith(DONE) else of_trial
    return said


def made(plan: Plan, unit: Unit) -> bytes:
    """Return the rows of a unit."""
    return pack(table_of_unit(plan.request, unit), experiment_of(unit).table)


def answer_of_a_fork(work: Callable[[], bytes], processor_s: float, longest_s: float, run_of: Connection) -> bytes:
    """Answer in a fork of this process, under its limits; it ends when the line to the run does."""
    reading, writing = os.pipe()
    child = os.fork()
    if not child:
        run_of.close()
        _answer_and_exit(work, processor_s, writing)
    os.setpgid(child, child)
    os.close(writing)
    try:
        content = _heard(reading, child, longest_s, run_of)
    finally:
        os.close(reading)
        code, used_s = _ended(child)
    if content is not None and content.endswith(COMPLETE):
        return content.removesuffix(COMPLETE)
    if content is None:
        return HUNG + f"it did not return within {longest_s:.3g} s".encode()
    if code in (-signal.SIGXCPU, -signal.SIGKILL) and used_s >= processor_s:
        return HUNG + f"it did not return within {processor_s:.3g} s of processor time".encode()
    return CRASHED + f"it ended its process ({ending(code)})".encode()


def _heard(reading: int, child: int, longest_s: float, run_of: Connection) -> bytes | None:
    """Return what a fork wrote until it ended, grandchildren or not, or else None; EOFError if the run has ended."""
    said, deadline = [], time.monotonic() + longest_s
    while (left := deadline - time.monotonic()) > 0.0:
        ready = wait([reading, run_of], min(LOOK_S, left))
        if run_of in ready:
            raise EOFError  # the run says nothing before it has its answer, so that this is its end
        if reading in ready:
            said.append(os.read(reading, 1 << 20))
            if not said[-1]:
                return b"".join(said)
        elif os.waitid(os.P_PID, child, os.WEXITED | os.WNOHANG | os.WNOWAIT):
            return b"".join(said)
    return None


def _ended(child: int) -> tuple[int, float]:
    """Return a fork's exit code and processor time; kill it, and what it forked, if it has not ended."""
    deadline = time.monotonic() + ENDING_S
    while not os.waitid(os.P_PID, child, os.WEXITED | os.WNOHANG | os.WNOWAIT) and time.monotonic() < deadline:
        time.sleep(0.001)
    os.killpg(child, signal.SIGKILL)
    _, status, used = os.wait4(child, 0)
    return os.waitstatus_to_exitcode(status), used.ru_utime + used.ru_stime


def _answer_and_exit(work: Callable[[], bytes], processor_s: float, writing: int) -> NoReturn:
    try:
        limit(processor_s, is_last=True)
        with open(writing, "wb") as pipe:
            pipe.write(answer(work) + COMPLETE)
        os._exit(0)
    finally:
        os._exit(1)  # what is no Exception, as sys.exit: the law wants to leave


def main(descriptor: int) -> None:
    """Answer until the run closes the connection."""
    with Connection(descriptor) as run_of:
        try:
            limit(READY_S)
            plan = plan_of(json.loads(run_of.recv_bytes()), load_law)
        except BenchError as error:
            # the file did import when its fields were read; it may be the sources that changed
            run_of.send_bytes((CRASHED if isinstance(error, BadLaw) else MISTAKE) + str(error).encode())
            return
        run_of.send_bytes(DONE)
        units = {unit.key: unit for unit in plan.units}
        while True:
            asked = json.loads(run_of.recv_bytes())
            unit = units[asked["key"]]
            if "processor_s" not in asked:
                limit(READY_S)
                run_of.send_bytes(prepared(plan, unit, run_of))
            else:
                some = unit.part(asked["first"], asked["count"]) if "count" in asked else unit
                limits = asked["processor_s"], asked["longest_s"]
                run_of.send_bytes(answer_of_a_fork(functools.partial(made, plan, some), *limits, run_of))


if __name__ == "__main__":
    try:
        main(int(sys.argv[1]))
    except (EOFError, ConnectionError):  # the run is gone
        sys.exit(1)
