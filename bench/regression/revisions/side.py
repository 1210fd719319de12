"""The process of one side: compiles a checkout's laws, writes their machine code, and times rounds when asked to.

Run by its path with the checkout as PYTHONPATH (`process.py`), so it is always the head's file, and imports of the
other side only what both have: bench.timing and what that stands on. It speaks JSON lines:

    in   {"laws": [...], "only": bool, "names": [...], "engines": bool, "objects": folder}   a user's law files; whether
             nothing but these; nothing but these names, if any; whether engines too; where machine code is written
    out  {"benchmarks": [{name, what, ticks, code, symbol}], "sources": ...}
    in   {"order": [names], "rounds": n}   once a session; {} ends the process
    out  {"waiting": true}                 before every round, when the one before it is done
    in   {"core": n}                       begin the round, on this core
    out  {"seconds": {name: [[law, kernel], ...]}}

A session is pytest-benchmark's: each of ours is one of its benchmarks, of so many rounds, whose set-up waits for the
word and then times the reference kernel, so that its time stands beside the round's. CPU time of the thread is taken.
"""

import contextlib
import hashlib
import io
import itertools
import json
import os
import re
import secrets
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from llvmlite import binding
from numba.core.bytecode import FunctionIdentity
from numba.core.codegen import JITCodeLibrary

TIMER = "time.thread_time"
ENGINES_OF = "rotation-matrix"
ON_ARM = ("ur5e", "rotation-matrix@geometric+solve")
BLOCKS, SWEEPS = 4, 5
"""Four times the states, with other goals each, five times over: 0.7 MB, which a second-level cache holds."""
GOAL = 12  # column of a state at which its goal begins

NAMES = re.compile(rb"[\w.$%]*v\d{6,}B[\w.$%]*")  # numba's names carry a number of its own drawing

_objects: dict[int, bytes] = {}
_kept = JITCodeLibrary._set_compiled_object


def _keep(library, code: bytes) -> None:
    """numba gives up an object that it took from its cache once it is linked; we want it then."""
    _objects[id(library)] = bytes(code)
    _kept(library, code)


JITCodeLibrary._set_compiled_object = _keep


class Channel:
    """JSON lines to and from the parent; all else that is printed goes to stderr."""

    def __init__(self):
        self.out = os.fdopen(os.dup(1), "w", encoding="utf-8")
        os.dup2(2, 1)

    def say(self, **words: Any) -> None:
        """One line to the parent."""
        self.out.write(json.dumps(words) + "\n")
        self.out.flush()

    def hear(self) -> dict[str, Any]:
        """The parent's next line; nothing when it has gone."""
        line = sys.stdin.readline()
        return json.loads(line) if line else {}


class Timed:
    """A benchmark: a call, and how many ticks it does."""

    def __init__(self, name: str, what: str, ticks: int, call):
        self.name, self.what, self.ticks, self.call = name, what, ticks, call
        self.code = self.symbol = ""


class Shuffled:
    """States in an order that is new in every round, and the same for both sides.

    A processor learns the branches of a thousand states that come again and again, in one process and not in another: a
    law with a branch then took 1.5 times as long. What comes in a new order is learnt in none.
    """

    def __init__(self, states: np.ndarray):
        self.states = states
        self.rows = np.empty((BLOCKS * len(states), states.shape[1]))
        self.draw(0)

    def draw(self, number: int) -> None:
        """The order of a round."""
        draw, count = np.random.default_rng(number), len(self.states)
        for rows in np.split(self.rows, BLOCKS):
            rows[:, :GOAL] = self.states[draw.permutation(count), :GOAL]
            rows[:, GOAL:] = self.states[draw.permutation(count), GOAL:]


def laws_alone(files: list[str], only: bool, names: list[str], folder: Path, shuffled: Shuffled) -> list[Timed]:
    """Every law in its latency chain, its machine code written to the folder."""
    from bench.contenders.law_file import load_law
    from bench.contenders.registry import all_contenders
    from bench.engines.binding import command_of, memory_of
    from bench.law.contender import Gains
    from bench.timing import law

    own = tuple(load_law(Path(path)) for path in files)
    known = [one for one in all_contenders(own) if one.regulator.origin or not only]
    # numba's own numbers, all of 17 digits: names of other lengths move what machine code refers to
    FunctionIdentity._unique_ids = itertools.count(10**16 + secrets.randbelow(8 * 10**16))
    gains = Gains()
    law.states().tofile(folder / "states")
    found = []
    for one in known:
        if one.regulator.in_engine or (names and one.name not in names):
            continue
        loop = law.loop_of(command_of(one), memory_of(one), cache=not one.regulator.origin)

        def call(loop=loop):
            return loop(shuffled.rows, gains.kp, gains.kv, SWEEPS)

        timed = Timed(one.name, "law", SWEEPS * len(shuffled.rows) if call() == 0.0 else 0, call)
        [compiled] = loop.overloads.values()
        code = _objects.get(id(compiled.library)) or compiled.library._get_compiled_object()
        timed.code, timed.symbol = digest(code), compiled.fndesc.mangled_name
        (folder / f"{timed.name.replace('/', '+')}.o").write_bytes(code)
        found.append(timed)
    return found


def digest(code: bytes) -> str:
    """Sixteen hex digits over instructions, what they refer to, and constants, without numba's numbered names."""
    found = hashlib.sha256()
    for section in binding.ObjectFileRef.from_data(code).sections():
        name = section.name() or b""
        if section.size() and any(word in name for word in (b"text", b"rodata")):
            found.update(name + b"\0" + NAMES.sub(b"", section.data()) + b"\0")
    return found.hexdigest()[:16]


def engines() -> list[Timed]:
    """Every compiled engine with one law, and one arm."""
    from bench.contenders import combinations
    from bench.contenders.registry import find_contender
    from bench.timing import on_arms
    from bench.timing.benchmarks import benchmarks

    one = find_contender(ENGINES_OF)
    arm, word = ON_ARM
    [controller] = combinations.on((word,), {one.name: one}, 6)
    loops = [loop for loop in benchmarks([one]) if loop.what == "engine" and loop.contender]
    named = [(f"{loop.engine} {one.name}", loop) for loop in loops]
    named.append((f"native {arm} {word}", on_arms.native(arm, controller)))
    return [Timed(name, "engine", benchmark.ticks, benchmark.call) for name, benchmark in named]


class Session:
    """The plugin that makes a test of each benchmark, and its set-up wait for the parent."""

    def __init__(self, channel: Channel, benchmarks: list[Timed], rounds: int, shuffled: Shuffled):
        from bench.timing import reference_kernel

        self.channel, self.benchmarks, self.rounds, self.shuffled = channel, benchmarks, rounds, shuffled
        chain, given = reference_kernel.compiled(), (reference_kernel.START, reference_kernel.STEPS)
        self.kernel = lambda: chain(*given)
        self.kernel_steps = reference_kernel.STEPS
        self.seconds: dict[str, list[list[float]]] = {}
        self.report = io.StringIO()
        self.redirected = contextlib.ExitStack()
        self.core: int | None = None

    @pytest.hookimpl(tryfirst=True)
    def pytest_configure(self):
        """Reporters keep the streams they find here: a buffer."""
        self.redirected.enter_context(contextlib.redirect_stdout(self.report))
        self.redirected.enter_context(contextlib.redirect_stderr(self.report))

    def pytest_generate_tests(self, metafunc):
        """One test a benchmark."""
        pairs = [(self, one) for one in self.benchmarks]
        metafunc.parametrize("timed", pairs, ids=lambda pair: pair[1].name)

    def on(self, core: int) -> None:
        """Move to a core, the same that the other side's round of this pair has, where that can be chosen."""
        if core != self.core and hasattr(os, "sched_setaffinity"):
            os.sched_setaffinity(0, {core})
            self.core = core

    def run(self) -> None:
        """All rounds of all benchmarks, in this order."""
        words = [
            *(__file__, "-c", os.devnull, "--rootdir", str(Path(__file__).parent), "--noconftest"),
            *("-p", "no:cacheprovider", "-p", "no:xdist", "-p", "no:faulthandler"),
            *("-q", "--exitfirst", "--capture=no", "--assert=plain", "-W", "ignore", "--import-mode=importlib"),
            *(f"--benchmark-timer={TIMER}", "--benchmark-disable-gc", "--benchmark-quiet"),
        ]
        with self.redirected:
            code = pytest.main(words, plugins=[self])
        if code != pytest.ExitCode.OK:
            raise RuntimeError(f"pytest ended with {code!r}:\n{self.report.getvalue()}")


def test_rounds(benchmark, timed):
    """One benchmark, all its rounds; each waits for the parent's word."""
    session, one = timed
    kernels: list[float] = []

    def wait():
        session.channel.say(waiting=True)
        session.on(session.channel.hear()["core"])
        session.shuffled.draw(len(kernels))
        began = time.thread_time()
        session.kernel()
        kernels.append((time.thread_time() - began) / session.kernel_steps)

    benchmark.pedantic(one.call, setup=wait, rounds=session.rounds, iterations=1)
    laws = np.array(benchmark.stats.stats.data) / one.ticks
    session.seconds[one.name] = [list(pair) for pair in zip(laws.tolist(), kernels, strict=True)]


def main() -> None:
    """Answer the parent until it has nothing more to ask."""
    channel = Channel()
    asked = channel.hear()
    from bench.provenance import source_digest
    from bench.timing import law

    if not Path(law.__file__).is_relative_to(Path.cwd()):  # another checkout's, installed, stood in for it
        raise ImportError("there is no bench.timing yet")
    shuffled = Shuffled(law.states())
    benchmarks = laws_alone(asked["laws"], asked["only"], asked["names"], Path(asked["objects"]), shuffled)
    if asked["engines"]:
        benchmarks += engines()
    kept = ("name", "what", "ticks", "code", "symbol")
    channel.say(benchmarks=[{key: getattr(one, key) for key in kept} for one in benchmarks], sources=source_digest())
    by_name = {one.name: one for one in benchmarks}
    while asked := channel.hear():
        session = Session(channel, [by_name[name] for name in asked["order"]], asked["rounds"], shuffled)
        session.run()
        channel.say(seconds=session.seconds)


if __name__ == "__main__":
    main()
