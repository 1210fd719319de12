"""Time every law alone and some engines, as benchmarks of pytest-benchmark, in turn with another process.

The program is run by its path with a checkout as PYTHONPATH, so both sides run this one file. The environment variable
ORIENTATION_BENCH_TIMED is a JSON object:

    laws, only, names, rounds   a user's law files; whether to time only them; names to time, or none for all
    words                       options of pytest, as --benchmark-json=FILE
    line, begins                a socket to the other process, or null, and whether this one has the first turn

`extra_info` holds what a benchmark is, the ticks of a round, `kernel_steps` (CPU time of a tick over a step of the
reference kernel: median and interval), and in one process alone a law's flops.
"""

import contextlib
import functools
import io
import json
import os
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

ENGINES_OF, ARM, ON_ARM = "rotation-matrix", "ur5e", "rotation-matrix@geometric+solve"
BLOCKS, SWEEPS = 4, 5  # four times the states with other goals, five times over: 0.7 MB fit a second-level cache
GOAL = 12  # column of a state at which its goal begins
OTHER_ENDED = 77  # the exit code of a process that lost the other one
WORDS = (
    *("-c", os.devnull, "--rootdir", str(Path(__file__).parent), "--noconftest", "--import-mode=importlib"),
    *("-p", "no:cacheprovider", "-p", "no:xdist", "-p", "no:faulthandler", "-q", "--exitfirst", "--capture=no"),
    *("--assert=plain", "-W", "ignore", "--benchmark-timer=time.thread_time", "--benchmark-disable-gc"),
)


class Turns:
    """The turns of two processes: one works while the other waits for a byte."""

    def __init__(self, line: int | None, begins: bool):
        self.line, self.begins = io.FileIO(line, "r+") if line else None, begins

    def agree(self, names: list[str]) -> list[str]:
        """Tell the other process the names of the benchmarks; return those that both have, in one order."""
        if self.line is None:
            return names
        self.send(json.dumps(names).encode() + b"\n")
        theirs = b""
        with contextlib.suppress(ConnectionError):
            theirs = self.line.readline()
        if not self.begins:
            self.send()
        return sorted(set(json.loads(theirs or b"[]")).intersection(names))

    def wait(self) -> None:
        """Wait for this process's turn."""
        with contextlib.suppress(ConnectionError):
            if self.line is None or self.line.read(1):
                return
        pytest.exit("the other side has ended", OTHER_ENDED)

    def send(self, words: bytes = b".") -> None:
        """Write to the other process; one byte gives it its turn."""
        with contextlib.suppress(ConnectionError):  # it has ended; `wait` notices if that was too early
            if self.line is not None:
                self.line.write(words)


def shuffle(states: np.ndarray, rows: np.ndarray, number: int) -> None:
    """Write states into rows, in an order that is new in every round and the same for both sides.

    A processor learns the branches of a thousand states that come again and again, in one process but not in another:
    a law with a branch then took 1.5 times as long.
    """
    draw, count = np.random.default_rng(number), len(states)
    for block in np.split(rows, BLOCKS):
        block[:, :GOAL] = states[draw.permutation(count), :GOAL]
        block[:, GOAL:] = states[draw.permutation(count), GOAL:]


def compile_benchmarks(asked: dict[str, Any], rows: np.ndarray) -> dict[str, Any]:
    """Compile laws, each in a loop over rows in which a tick waits for the command of the one before, and engines."""
    from bench.engines.binding import command_of, memory_of
    from bench.law.contenders import combinations, registry
    from bench.law.contenders.law_file import load_law
    from bench.law.inputs import Gains
    from bench.running.timing import benchmarks, law, on_arms
    from bench.running.timing.benchmark import ENGINE, LAW, Benchmark

    gains, found = Gains(), []
    for one in registry.all_contenders(tuple(load_law(Path(path)) for path in asked["laws"])):
        if one.regulator.in_engine or (asked["only"] and not one.regulator.origin):
            continue
        if one.name not in (asked["names"] or [one.name]):
            continue
        loop = law.loop_of(command_of(one), memory_of(one), cache=not one.regulator.origin)
        call = functools.partial(loop, rows, gains.kp, gains.kv, SWEEPS)
        if call() == 0.0:  # a command that is not finite breaks the chain
            found.append(Benchmark(LAW, one, "", SWEEPS * len(rows), call))
    if not asked["only"] and any(" " in name for name in asked["names"] or " "):
        one = registry.find_contender(ENGINES_OF)
        [controller] = combinations.on((ON_ARM,), {one.name: one}, 6)
        found += [loop for loop in benchmarks.benchmarks([one]) if loop.what == ENGINE and loop.contender]
        found.append(on_arms.native(ARM, controller))
    named = {one.name.removeprefix(f"{LAW} "): one for one in found}
    return {name: one for name, one in named.items() if name in (asked["names"] or named)}


class Session:
    """The plugin that makes a test of each benchmark, and says which machine it ran on."""

    def __init__(self, asked: dict[str, Any]):
        from bench.running.timing import law, reference_kernel

        if not Path(law.__file__).is_relative_to(Path.cwd()):  # another checkout's, installed
            raise ImportError("there is no bench.running.timing yet")
        self.rounds, self.turns = asked["rounds"], Turns(asked["line"], asked["begins"])
        self.cores = sorted(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else []
        states, chain, self.kernel_steps = law.states(), reference_kernel.compiled(), reference_kernel.STEPS
        rows = np.tile(states, (BLOCKS, 1))
        self.shuffle = lambda number: shuffle(states, rows, number)
        self.kernel = lambda: chain(reference_kernel.START, reference_kernel.STEPS)
        known = compile_benchmarks(asked, rows)
        self.benchmarks = {name: known[name] for name in self.turns.agree(list(known))}

    def pytest_generate_tests(self, metafunc: pytest.Metafunc) -> None:
        """Make one test of each benchmark."""
        metafunc.parametrize("name", list(self.benchmarks))

    @pytest.fixture
    def plugin(self) -> "Session":
        """Give the test this plugin."""
        return self

    @pytest.hookimpl(tryfirst=True)
    def pytest_benchmark_generate_machine_info(self) -> dict[str, Any]:
        """Name the kind of machine, and not the machine."""
        from bench.base.provenance import describe, machine_key

        about = describe()
        kept = {name: about[name] for name in ("cores", "platform", "versions", "sources")}
        return {"key": machine_key(), "cpu": {"brand_raw": about["cpu"]}, **kept}

    def pytest_benchmark_update_commit_info(self, commit_info: dict[str, Any]) -> None:
        """Leave out the names of a branch and of a folder."""
        commit_info.update(project="orientation-bench", branch="")


def test_ticks(benchmark: Any, plugin: Session, name: str) -> None:
    """Time one benchmark for all its rounds, each in its turn."""
    from bench.experiments.costs import count_operations
    from bench.running.timing.ratios import ratio

    one = plugin.benchmarks[name]
    kernels: list[float] = []
    if plugin.cores:  # both sides on one core, else one might have the busier neighbour
        os.sched_setaffinity(0, {plugin.cores[list(plugin.benchmarks).index(name) % len(plugin.cores)]})

    def wait() -> None:
        plugin.turns.wait()
        plugin.shuffle(len(kernels))
        began = time.thread_time()
        plugin.kernel()
        kernels.append((time.thread_time() - began) / plugin.kernel_steps)

    benchmark.pedantic(one.call, setup=wait, teardown=plugin.turns.send, rounds=plugin.rounds, iterations=1)
    steps = list(ratio(np.array(benchmark.stats.stats.data) / one.ticks, np.array(kernels)))
    costs = count_operations(one.contender) if plugin.turns.line is None and one.what == "law" else []
    flops = {row["branch"]: int(row["flops"]) for row in costs if row["stage"] == "total"}
    benchmark.extra_info.update(what=one.what, ticks=one.ticks, kernel_steps=steps, flops=flops)


def main() -> int:
    """Compile, agree with the other process, and time; return pytest's exit code."""
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
