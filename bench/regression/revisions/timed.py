"""Time every law alone and some engines, as benchmarks of pytest-benchmark, in turn with another process.

The program is run by its path with a checkout as PYTHONPATH, so both sides of a comparison run this one file. The
environment variable ORIENTATION_BENCH_TIMED is a JSON object:

    laws, only, names, rounds   a user's law files; whether to time only them; names to time, or none for all
    words                       options of pytest, as --benchmark-json=FILE
    read, write, begins         pipes from and to the other process, and whether this one has the first turn

Before each round, which is a call of a fixed number of ticks, the reference kernel is timed. The CPU time of the thread
is taken. `extra_info` of each benchmark holds `what`, `ticks`, `kernel_steps` (the time of a tick over a step of the
reference kernel: median and interval), and, if there is no other process, a law's `flops` by branch.
"""

import contextlib
import io
import json
import os
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

ENGINES_OF = "rotation-matrix"
ON_ARM = ("ur5e", "rotation-matrix@geometric+solve")
BLOCKS, SWEEPS = 4, 5
"""Four times the states, each time with other goals, five times over: 0.7 MB, which fits a second-level cache."""
GOAL = 12  # column of a state at which its goal begins
OTHER_ENDED = 77
"""The exit code of a process that lost the other one."""
WORDS = (
    *("-c", os.devnull, "--rootdir", str(Path(__file__).parent), "--noconftest", "--import-mode=importlib"),
    *("-p", "no:cacheprovider", "-p", "no:xdist", "-p", "no:faulthandler", "-q", "--exitfirst", "--capture=no"),
    *("--assert=plain", "-W", "ignore", "--benchmark-timer=time.thread_time", "--benchmark-disable-gc"),
)


class Timed(NamedTuple):
    """A benchmark: whether it is a "law" or an "engine", how many ticks a call does, the call, and flops by branch."""

    what: str
    ticks: int
    call: Callable
    flops: dict[str, int] = {}  # noqa: RUF012  a tuple's default, never written to


class Turns:
    """The turns of two processes: one works while the other waits for a byte."""

    def __init__(self, read: int | None, write: int | None, begins: bool):
        self.pipe = None if read is None else io.FileIO(read)
        self.write, self.begins = write, begins

    def agree(self, names: list[str]) -> list[str]:
        """Tell the other process the names of the benchmarks; return those that both have, in one order."""
        if self.pipe is None:
            return names
        self.send(json.dumps(names).encode() + b"\n")
        theirs = set(json.loads(self.pipe.readline() or b"[]"))
        if not self.begins:
            self.send()
        return sorted(theirs.intersection(names))

    def wait(self) -> None:
        """Wait for this process's turn."""
        if self.pipe is not None and not self.pipe.read(1):
            pytest.exit("the other side has ended", OTHER_ENDED)

    def send(self, words: bytes = b".") -> None:
        """Write to the other process; one byte gives it its turn."""
        with contextlib.suppress(BrokenPipeError):  # it has ended; `wait` notices if that was too early
            if self.write is not None:
                os.write(self.write, words)


def shuffle(states: np.ndarray, rows: np.ndarray, number: int) -> None:
    """Write states into rows, in an order that is new in every round and the same for both sides.

    A processor learns the branches of a thousand states that come again and again, in one process but not in another:
    a law with a branch then took 1.5 times as long.
    """
    draw, count = np.random.default_rng(number), len(states)
    for block in np.split(rows, BLOCKS):
        block[:, :GOAL] = states[draw.permutation(count), :GOAL]
        block[:, GOAL:] = states[draw.permutation(count), GOAL:]


def compile_laws(asked: dict[str, Any], rows: np.ndarray) -> dict[str, Timed]:
    """Compile laws, each in a loop over rows in which a tick waits for the command of the one before."""
    from bench.contenders.law_file import load_law
    from bench.contenders.registry import all_contenders
    from bench.counting import TOTAL
    from bench.engines.binding import command_of, memory_of
    from bench.law.contender import Gains
    from bench.tables import kept_costs
    from bench.timing import law

    gains, found = Gains(), {}
    for one in all_contenders(tuple(load_law(Path(path)) for path in asked["laws"])):
        is_wanted = one.regulator.origin or not asked["only"]
        if one.regulator.in_engine or not is_wanted or one.name not in (asked["names"] or [one.name]):
            continue
        loop = law.loop_of(command_of(one), memory_of(one), cache=not one.regulator.origin)

        def call(loop=loop):
            return loop(rows, gains.kp, gains.kv, SWEEPS)

        if call() == 0.0:  # a command that is not finite breaks the chain
            costs = [] if asked["read"] else kept_costs.of_law(one)
            flops = {row["branch"]: int(row["flops"]) for row in costs if row["stage"] == TOTAL}
            found[one.name] = Timed("law", SWEEPS * len(rows), call, flops)
    return found


def compile_engines(asked: dict[str, Any]) -> dict[str, Timed]:
    """Compile every engine of the free body with one law, and one arm."""
    from bench.contenders import combinations
    from bench.contenders.registry import find_contender
    from bench.timing import on_arms
    from bench.timing.benchmarks import benchmarks

    if asked["only"] or (asked["names"] and not any(" " in name for name in asked["names"])):
        return {}
    one, (arm, word) = find_contender(ENGINES_OF), ON_ARM
    [controller] = combinations.on((word,), {one.name: one}, 6)
    loops = {
        f"{loop.engine} {one.name}": loop for loop in benchmarks([one]) if loop.what == "engine" and loop.contender
    }
    loops[f"native {arm} {word}"] = on_arms.native(arm, controller)
    return {
        name: Timed("engine", loop.ticks, loop.call)
        for name, loop in loops.items()
        if name in (asked["names"] or loops)
    }


class Session:
    """The plugin that makes a test of each benchmark, and says which machine it ran on."""

    def __init__(self, asked: dict[str, Any]):
        from bench.timing import law, reference_kernel

        self.rounds, self.turns = asked["rounds"], Turns(asked["read"], asked["write"], asked["begins"])
        self.cores = sorted(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else []
        states, chain = law.states(), reference_kernel.compiled()
        rows = np.tile(states, (BLOCKS, 1))
        self.shuffle = lambda number: shuffle(states, rows, number)
        self.kernel = lambda: chain(reference_kernel.START, reference_kernel.STEPS)
        self.kernel_steps = reference_kernel.STEPS
        known = {**compile_laws(asked, rows), **compile_engines(asked)}
        self.benchmarks = {name: known[name] for name in self.turns.agree(list(known))}

    def pytest_generate_tests(self, metafunc):
        """Make one test of each benchmark."""
        metafunc.parametrize("name", list(self.benchmarks))

    @pytest.fixture
    def plugin(self):
        """Give the test this plugin."""
        return self

    @pytest.hookimpl(tryfirst=True)
    def pytest_benchmark_generate_machine_info(self):
        """Name the kind of machine, and not the machine."""
        from bench.provenance import describe, machine_key

        about = describe()
        kept = {name: about[name] for name in ("cores", "platform", "versions", "sources")}
        return {"key": machine_key(), "cpu": {"brand_raw": about["cpu"]}, **kept}

    def pytest_benchmark_update_commit_info(self, commit_info):
        """Leave out the names of a branch and of a folder."""
        commit_info.update(project="orientation-bench", branch="")


def test_ticks(benchmark, plugin, name):
    """Time one benchmark for all its rounds, each in its turn."""
    from bench.timing.ratios import ratio

    one = plugin.benchmarks[name]
    kernels: list[float] = []
    if plugin.cores:  # both sides on one core, else one might have the busier neighbour
        os.sched_setaffinity(0, {plugin.cores[list(plugin.benchmarks).index(name) % len(plugin.cores)]})

    def wait():
        plugin.turns.wait()
        plugin.shuffle(len(kernels))
        began = time.thread_time()
        plugin.kernel()
        kernels.append((time.thread_time() - began) / plugin.kernel_steps)

    benchmark.pedantic(one.call, setup=wait, teardown=plugin.turns.send, rounds=plugin.rounds, iterations=1)
    steps = list(ratio(np.array(benchmark.stats.stats.data) / one.ticks, np.array(kernels)))
    benchmark.extra_info.update(what=one.what, ticks=one.ticks, kernel_steps=steps, flops=one.flops)


def main() -> int:
    """Compile, agree with the other process, and time; return pytest's exit code."""
    from bench.timing import law

    if not Path(law.__file__).is_relative_to(Path.cwd()):  # another checkout's, installed
        raise ImportError("there is no bench.timing yet")
    asked, report = json.loads(os.environ["ORIENTATION_BENCH_TIMED"]), io.StringIO()
    session = Session(asked)
    if not session.benchmarks:
        return 0
    with contextlib.redirect_stdout(report):
        code = pytest.main([__file__, *WORDS, *asked["words"]], plugins=[session])
    if code:
        print(report.getvalue(), file=sys.stderr)
    return int(code)


if __name__ == "__main__":
    sys.exit(main())
