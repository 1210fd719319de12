"""Time ticks with pytest-benchmark: options, the fixture `time_ticks`, and the saved file.

A benchmark is timed in rounds of one call. Before each round the reference kernel is timed, and
`kernel_steps` of a saved benchmark is the CPU time of a tick over that of a step of the kernel in
the same round: the median over rounds, and its 95 % interval. Times in seconds of two runs differ
as the machine does; `kernel_steps` of them do much less.

It is CPU time of this thread (time.thread_time) that counts, not the clock on the wall: on a shared
machine that leaves out the time in which others ran. No benchmark uses a second thread.

`extra_info` of a saved benchmark holds what was timed (`what`, `contender`, `engine`, `arm`), the
`ticks` of a round, `kernel_steps`, `kernel_ns` (a step of the kernel, median), and a law's `flops`
by branch. The file's `not_timed` lists what fails. Where two processes time in turns
(`bench compare`), both time only what both have.
"""

import os
import random
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

from bench.base.errors import BenchError
from bench.base.provenance import describe, machine_key
from bench.experiments.costs import count_operations
from bench.law.contender import Contender
from bench.law.contenders import registry
from bench.law.contenders.law_file import load_law
from benchmarks import reference_kernel
from benchmarks.subject import LAW, Subject
from benchmarks.turns import Turns
from tasks import arm_names

ROUNDS = 31
"""Odd, so that the median is a value; its interval covers the 10th to the 22nd of 31."""


@dataclass
class Choice:
    """Hold what this run times.

    Attributes:
        laws: Laws, in the order of the registry, users' laws last.
        arms: Arms.
        turns: Turns with another process, if there is one.
        cores: Processor cores that this process may use; empty where the system does not say.
        not_timed: What the subjects say of themselves that could not be timed.
    """

    laws: list[Contender]
    arms: list[str]
    turns: Turns
    cores: list[int] = field(default_factory=list)
    not_timed: list[dict[str, Any]] = field(default_factory=list)

    def find_law(self, name: str) -> Contender:
        """Return the law of a name."""
        return next(law for law in self.laws if law.name == name)


CHOICE = pytest.StashKey[Choice]()


class Option(NamedTuple):
    """An option that may be repeated.

    Attributes:
        name: The option.
        field: Name of its list of values.
        metavar: What stands for a value in the help.
        help: What a value does.
        kind: Type of a value.
    """

    name: str
    field: str
    metavar: str
    help: str
    kind: type = str


REPEATABLE = (
    Option(
        "--law",
        "law_files",
        "FILE",
        "Time the law of this file, too. Its code runs in this process.",
        Path,
    ),
    Option(
        "--contender",
        "contenders",
        "NAME",
        "Time only this law, as hybrid or linearized-euler/zyx-euler.",
    ),
    Option("--arm", "arms", "ARM", "Time only this arm."),
)


def pytest_addoption(parser):
    """Add the options of these benchmarks to those of pytest-benchmark."""
    group = parser.getgroup("control ticks")
    group.addoption("--rounds", type=int, default=ROUNDS, help="Rounds of each benchmark.")
    for option in REPEATABLE:
        group.addoption(
            option.name,
            dest=option.field,
            action="append",
            type=option.kind,
            default=[],
            metavar=option.metavar,
            help=f"{option.help} May be repeated.",
        )
    group.addoption("--only-files", action="store_true", help="Time only the laws of --law.")
    group.addoption(
        "--shuffle",
        type=int,
        metavar="SEED",
        help="Time in the random order of this seed.",
    )
    group.addoption(
        "--turns",
        type=int,
        metavar="DESCRIPTOR",
        help="Socket to another process, which times in turns with this one.",
    )
    group.addoption(
        "--first",
        action="store_true",
        help="With --turns: this process has the first turn.",
    )


def pytest_configure(config):
    """Choose what is timed; an unknown name, or a law that does not load, is a usage error."""
    refuse_foreign_sources(config.rootpath)
    try:
        config.stash[CHOICE] = choose(config)
    except BenchError as error:
        raise pytest.UsageError(str(error)) from error


def refuse_foreign_sources(checkout: Path) -> None:
    """Raise a usage error if a module of ours comes from elsewhere: an older checkout lacks it."""
    for name, module in list(sys.modules.items()):
        is_ours = name.partition(".")[0] in ("bench", "tasks")
        file = getattr(module, "__file__", None)
        if is_ours and file and not Path(file).is_relative_to(checkout):
            raise pytest.UsageError(f"{checkout} has no {name}: it is too old for these benchmarks")


def choose(config) -> Choice:
    """Return what the options choose."""
    users_laws = tuple(load_law(path) for path in config.option.law_files)
    laws = []
    for law in registry.all_contenders(users_laws):
        # MuJoCo's own actuator is left out: no law of ours runs there.
        if not law.regulator.in_engine:
            laws.append(law)
    if config.option.only_files:
        laws = [law for law in laws if law.regulator.origin]
    if config.option.contenders:
        named = [registry.find_contender(name, users_laws) for name in config.option.contenders]
        laws = [law for law in laws if law in named]
    has_cores = hasattr(os, "sched_getaffinity")
    return Choice(
        laws=laws,
        arms=config.option.arms or list(arm_names()),
        turns=Turns(config.option.turns, config.option.first),
        cores=sorted(os.sched_getaffinity(0)) if has_cores else [],
    )


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config, items):
    """Time by CPU time, in the chosen order, and only what the other process has, too."""
    here = Path(__file__).parent
    ours = [item for item in items if item.path.is_relative_to(here)]
    for item in ours:
        item.add_marker(pytest.mark.benchmark(timer=time.thread_time, disable_gc=True))
    if config.option.shuffle is not None:
        random.Random(config.option.shuffle).shuffle(items)
    turns = config.stash[CHOICE].turns
    if not turns.is_alone:
        names = turns.exchange(sorted(item.name for item in ours))
        items[:] = sorted((item for item in ours if item.name in names), key=lambda item: item.name)


@pytest.fixture(scope="session")
def choice(pytestconfig) -> Choice:
    """What this run times."""
    return pytestconfig.stash[CHOICE]


@pytest.fixture
def on_one_core(request, choice):
    """Return the function that keeps the timed rounds on one core, as busy for both processes."""

    def stay() -> None:
        if choice.cores:
            number = request.session.items.index(request.node)
            os.sched_setaffinity(0, {choice.cores[number % len(choice.cores)]})

    yield stay
    if choice.cores:
        os.sched_setaffinity(0, choice.cores)


@pytest.fixture
def time_ticks(benchmark, choice, on_one_core, pytestconfig) -> Callable[[Subject], None]:
    """Return the function that times a subject in all its rounds, each in its turn."""
    turns = choice.turns
    kernel_s: list[float] = []

    def time_subject(subject: Subject) -> None:
        refuse_foreign_sources(pytestconfig.rootpath)
        can_all = turns.exchange([subject.ticks > 0])
        if not subject.ticks or not can_all[0]:
            choice.not_timed.append(subject.describe())
            pytest.skip("the law fails, so there is nothing to time")

        def prepare() -> None:
            turns.wait()
            subject.prepare(len(kernel_s))
            kernel_s.append(reference_kernel.time_step())

        on_one_core()
        turns.begin()
        rounds = pytestconfig.option.rounds
        benchmark.pedantic(subject.call, setup=prepare, teardown=turns.give, rounds=rounds)
        turns.end()
        if benchmark.enabled:
            seconds = np.array(benchmark.stats.stats.data)
            benchmark.extra_info.update(subject.describe())
            tick_s = seconds / subject.ticks
            steps = reference_kernel.compare(tick_s, np.array(kernel_s))
            benchmark.extra_info.update(steps)
            benchmark.extra_info["flops"] = count_flops(subject) if turns.is_alone else {}

    return time_subject


def count_flops(subject: Subject) -> dict[str, int]:
    """Return the flops of a law alone by branch; empty for everything else."""
    if subject.what != LAW:
        return {}
    costs = count_operations(subject.contender)
    return {row["branch"]: int(row["flops"]) for row in costs if row["stage"] == "total"}


@pytest.hookimpl(tryfirst=True)
def pytest_benchmark_generate_machine_info() -> dict[str, Any]:
    """Name the kind of machine, and not the machine."""
    about = describe()
    return {
        "key": machine_key(),
        "cpu": {"brand_raw": about["cpu"]},
        "cores": about["cores"],
        "platform": about["platform"],
        "versions": about["versions"],
        "sources": about["sources"],
    }


def pytest_benchmark_update_commit_info(commit_info):
    """Leave out the names of a branch and of a folder."""
    commit_info.update(project="orientation-bench", branch="")


def pytest_benchmark_update_json(config, output_json):
    """Say in the saved file what could not be timed."""
    output_json["not_timed"] = config.stash[CHOICE].not_timed
