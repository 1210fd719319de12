"""Compile what a run needs in a process of its own, in the order in which the run needs it.

The compiler holds Python's lock and never frees its memory: a law that is compiled takes 6 MB or more, one that is
loaded from the cache on disk 2 MB. So the run waits for each contender until it is in the cache, and loads it. After
that the process counts operations of laws, for the run's end.
"""

import contextlib
import functools
import importlib
import json
import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence

from bench.base.processes import module_command
from bench.experiments.experiment import Unit, experiment_of
from bench.experiments.plan import Plan
from bench.running.wire_format import described, plan_of

WORTH = 8
"""Contenders from which on a process more is worth its start of some seconds."""

LIFE = 80
"""Requests after which a fresh fork goes on, without the memory that the one before has filled."""

SILENT_S = 120.0
"""Seconds without a request done after which the run compiles for itself: some ten times what a loop takes."""

ENGINES = ("simulate_arms", "simulate_bodies", "simulate_contact")
"""Modules of bench.engines that all forks share."""


class Ahead:
    """The process that compiles, and what it has compiled."""

    def __init__(self, process: subprocess.Popen, units: Sequence[Unit]) -> None:
        self.process, self._heard_s = process, time.monotonic()
        self._compiled = {_kind(unit): threading.Event() for unit in units}
        threading.Thread(target=self._follow, args=(units,), daemon=True).start()

    def wait_for(self, unit: Unit, stop: threading.Event) -> None:
        """Wait until what a unit needs is compiled, the process has ended or is silent, or `stop` is set."""
        compiled = self._compiled.get(_kind(unit))
        while compiled and not stop.is_set() and time.monotonic() < self._heard_s + SILENT_S:
            if compiled.wait(0.2):
                break

    def _follow(self, units: Sequence[Unit]) -> None:
        assert self.process.stdout
        try:
            for line in self.process.stdout:
                self._heard_s = time.monotonic()
                if int(line) < len(units):
                    self._compiled[_kind(units[int(line)])].set()
        finally:
            for compiled in self._compiled.values():
                compiled.set()


def _kind(unit: Unit) -> tuple:
    """Return what units have in common that need the same compiled code."""
    return unit.experiment, unit.engine, unit.contender, bool(unit.arm)


@contextlib.contextmanager
def compiling_ahead(plan: Plan, units: Sequence[Unit]) -> Iterator[Ahead | None]:
    """Let another process compile what these units need, while inside; none for fewer contenders than WORTH."""
    from bench.law.contenders.registry import all_contenders

    heads = list({_kind(unit): unit for unit in reversed(units)}.values())[::-1]
    names = dict.fromkeys(unit.contender for unit in heads)
    if len(names) < WORTH:
        yield None
        return
    counted = [one.name for one in all_contenders() if one.name in names]
    command, quiet = module_command(__name__, str(os.getpid())), subprocess.DEVNULL
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=quiet, text=True, start_new_session=True
    ) as process:
        try:
            assert process.stdin
            with contextlib.suppress(BrokenPipeError), process.stdin:
                json.dump({"plan": described(plan, heads), "count": counted}, process.stdin)
            yield Ahead(process, heads)
        finally:
            process.terminate()


def main(parent: int, content: dict) -> None:
    """Do what the content asks for, and print the number of each request when it is done, as long as the parent lives.

    Forks do it, LIFE requests each: the run finds the error of one that fails when it compiles for itself.
    """
    threading.Thread(target=end_without, args=(parent,), daemon=True).start()
    for name in ENGINES:
        importlib.import_module(f"bench.engines.{name}")
    from bench.experiments.costs import count_operations
    from bench.law.contenders.registry import find_contender

    plan = plan_of(content["plan"])
    work: list[Callable[[], object]] = [
        *(functools.partial(experiment_of(unit).prepare, plan.request, unit) for unit in plan.units),
        *(functools.partial(count_operations, find_contender(name)) for name in content["count"]),
    ]
    for first in range(0, len(work), LIFE):
        some = range(first, min(first + LIFE, len(work)))
        if child := os.fork():
            os.waitpid(child, 0)
            print(*some, sep="\n", flush=True)
            continue
        threading.Thread(target=end_without, args=(os.getppid(),), daemon=True).start()
        for number in some:
            with contextlib.suppress(Exception):
                work[number]()
            print(number, flush=True)
        os._exit(0)


def end_without(parent: int) -> None:
    """End this process when that one, its parent, has ended."""
    while os.getppid() == parent:
        time.sleep(0.2)
    os._exit(1)  # in the middle of a compilation; a file of the cache is there whole or not at all


if __name__ == "__main__":
    main(int(sys.argv[1]), json.load(sys.stdin))
