"""Run the benchmarks of tests/benchmarks with pytest-benchmark, of one checkout or two.

Each side is a process of pytest, and the rounds of two sides alternate, so that a slow moment of
the machine meets both. Both sides run the same files: a checkout of another revision is given ours
(`copy_benchmarks`).
"""

import contextlib
import os
import re
import secrets
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

from bench.base.errors import Incompatible
from bench.base.files import read_json
from bench.base.isolated import confine, end_all
from bench.base.processes import law_environment
from bench.base.provenance import ROOT

BENCHMARKS = Path("tests", "benchmarks")
"""Folder of the benchmarks in a checkout."""

LAWS_FILE = BENCHMARKS / "test_laws.py"
ENGINES_FILE = BENCHMARKS / "test_engines.py"
ARMS_FILE = BENCHMARKS / "test_arms.py"

LAWS = f"{LAWS_FILE}::test_law"
"""The benchmarks of every law alone."""

USUAL = (
    LAWS,
    f"{ENGINES_FILE}::test_engine[engine ideal-held rotation-matrix]",
    f"{ENGINES_FILE}::test_engine[engine ideal-rk4 rotation-matrix]",
    f"{ENGINES_FILE}::test_engine[engine native rotation-matrix]",
    f"{ARMS_FILE}::test_arm[engine ur5e native rotation-matrix@geometric+solve]",
)
"""What two revisions are compared by, and what the history holds."""

ROUNDS = 60
"""The interval of a median covers the 23rd to 38th; a round takes from 0.3 ms to 20 ms."""

SILENT_S = 300.0
"""On the wall, until processes that say nothing are ended: ten times what compiling a law takes."""

LOOK_S = 0.2
"""How often the timer looks whether a process has ended, and what it prints then."""

OPTIONS = (
    *("-c", os.devnull, "--rootdir", ".", "--confcutdir", str(BENCHMARKS)),
    *("-p", "no:cacheprovider", "-p", "no:xdist", "-p", "no:faulthandler"),
    *("-v", "-rfE", "--tb=line", "--exitfirst", "--assert=plain", "-W", "ignore"),
    *("-o", "console_output_style=count", "--benchmark-only", "--benchmark-quiet"),
)
"""No settings and no conftest of the other tests; a line for each benchmark as it ends."""

OTHER_ENDED = 77
"""Exit code of a process that lost the other one (tests/benchmarks/turns.py)."""

NOTHING_COLLECTED = 5
"""Exit code of pytest where no benchmark is left, as where two sides have none in common."""

ENDED_WELL = (0, NOTHING_COLLECTED, OTHER_ENDED)

PROGRESS = re.compile(
    r"\[(?P<name>[^\]]+)\] (?:PASSED|SKIPPED).*"
    r"\[ *(?P<done>\d+)/(?P<total>\d+)\]"
)
"""A line of pytest about a benchmark that has a name and has ended."""

REASONS = (
    re.compile(r"^(?:FAILED|ERROR) \S.* - (?P<reason>.+)"),
    re.compile(r"^ERROR: (?P<reason>.+)"),
    re.compile(r"^E +(?P<reason>.+)"),
)
"""Lines of pytest that say why it failed; the last of them counts."""

SUMMARY = re.compile(r"\b(?:passed|skipped|deselected|no tests ran)\b.* in [\d.]+s")
"""The last line of a pytest that came to its end."""


class Side(NamedTuple):
    """What one process times.

    Attributes:
        path: Checkout whose sources are timed.
        laws: Files of a user's laws.
        only: Whether only the user's laws count.
        names: Names of the laws to time; none: all.
        name: What the side is called.
        digest: Digest of its sources.
        benchmarks: Node ids of pytest; what is timed.
    """

    path: Path
    laws: tuple[Path, ...] = ()
    only: bool = False
    names: tuple[str, ...] = ()
    name: str = ""
    digest: str = ""
    benchmarks: tuple[str, ...] = USUAL

    @property
    def is_new(self) -> bool:
        """Return whether there is nothing to compare: none of the law files is there yet."""
        return self.only and not self.laws


class Progress(NamedTuple):
    """A benchmark that has ended, how many have, and of how many."""

    name: str
    done: int
    total: int


class SideFailed(Incompatible):
    """A process ended with an error; `at` is its place among those that were started."""

    def __init__(self, at: int, reason: str):
        super().__init__(reason)
        self.at = at


@dataclass
class TimedRun:
    """A process of pytest, and the log that it writes.

    Attributes:
        process: The process.
        log: File of its output.
        file: File of pytest-benchmark that it writes at its end.
        read: Output that was read so far.
        heard: When the output last grew [s, of time.monotonic].
    """

    process: subprocess.Popen
    log: Path
    file: Path
    read: str = ""
    heard: float = field(default_factory=time.monotonic)

    def hear(self) -> list[Progress]:
        """Read what is new of the output, and return the benchmarks that have ended since."""
        text = self.log.read_text(encoding="utf-8", errors="replace")
        # A line that is not finished is read again.
        whole = text[: text.rfind("\n") + 1]
        new = whole[len(self.read) :]
        if text != self.read:
            self.heard = time.monotonic()
        self.read = whole
        ended = []
        for match in PROGRESS.finditer(new):
            ended.append(Progress(match["name"], int(match["done"]), int(match["total"])))
        return ended

    def has_ended(self) -> bool:
        """Return whether the process has ended."""
        return self.process.poll() is not None

    def has_failed(self) -> bool:
        """Return whether an ended process failed; one that a law ended says no summary."""
        code = self.process.returncode
        if code == OTHER_ENDED:
            return False
        return code not in ENDED_WELL or not SUMMARY.search(self.read)

    def explain(self) -> str:
        """Return why the process failed, in a line."""
        lines = self.read.strip().splitlines()
        for line in reversed(lines):
            for pattern in REASONS:
                if match := pattern.match(line):
                    return match["reason"]
        return f"it ended with exit code {self.process.poll()}"


def copy_benchmarks(checkout: Path) -> None:
    """Put our benchmarks into a checkout of another revision, which may have others or none.

    Each checkout has a copy of its own because compiled code is kept by the path of its file.
    """
    target = checkout / BENCHMARKS
    shutil.rmtree(target, ignore_errors=True)
    shutil.copytree(ROOT / BENCHMARKS, target, ignore=shutil.ignore_patterns("__pycache__"))


def run_benchmarks(
    sides: list[Side],
    options: tuple[str, ...] = (),
    rounds: int = ROUNDS,
    report: Callable[[Progress], None] = lambda _: None,
) -> list[dict[str, Any]]:
    """Time one side, or two in turns; return the files of pytest-benchmark.

    options: of pytest. report: is called with each benchmark that the last side has timed.

    Errors:
        Incompatible: there are no benchmarks in this installation.
        SideFailed: a law cannot be compiled, or a process failed or said nothing for SILENT_S.
    """
    if not (ROOT / BENCHMARKS).is_dir():
        raise Incompatible(
            f"time is measured by {BENCHMARKS} of a checkout, and {ROOT} is none; clone the repository and run it there"
        )
    with contextlib.ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="orientation-bench-")))
        ends = [stack.enter_context(end) for end in socket.socketpair()]
        runs = []
        for at, side in enumerate(sides):
            words = [*options, f"--rounds={rounds}"]
            sockets = []
            if len(sides) > 1:
                sockets = [ends[at].fileno()]
                words += [f"--turns={sockets[0]}", *["--first"] * (at == 0)]
            runs.append(_start(stack, side, words, sockets, folder / str(at)))
        for end in ends:
            end.close()
        failed = _wait_for(runs, report)
        if failed is not None:
            checkout = sides[failed].path
            reason = runs[failed].explain()
            raise SideFailed(failed, f"laws of {checkout} cannot be compiled and timed ({reason})")
        files = []
        for run in runs:
            # pytest-benchmark writes no file where nothing was timed.
            empty: dict[str, Any] = {"benchmarks": [], "not_timed": []}
            files.append(read_json(run.file) if run.file.is_file() else empty)
        return files


def _start(
    stack: contextlib.ExitStack,
    side: Side,
    options: list[str],
    sockets: list[int],
    place: Path,
) -> TimedRun:
    """Start the process of a side, which ends with the stack; place: its files, without suffix."""
    variables = dict(os.environ)
    token = secrets.token_hex(8)
    if side.laws:
        # A user's law may change what is compiled beside it, and an older revision keeps that: so
        # it is kept nowhere.
        variables = law_environment(token)
        variables["NUMBA_CACHE_DIR"] = str(place.with_suffix(".compiled"))
    # Under variables of pytest-xdist, pytest-benchmark would switch itself off; others are options
    # of pytest.
    variables = {name: value for name, value in variables.items() if not name.startswith("PYTEST_")}
    variables |= {"PYTHONPATH": str(side.path), "PYTHONHASHSEED": "0", "PYTHONUNBUFFERED": "1"}
    # As wide as no line is: pytest cuts the reason of a failure.
    variables["COLUMNS"] = "1000"
    benchmarks = (LAWS,) if side.only else side.benchmarks
    words = [sys.executable, "-P", "-m", "pytest", *benchmarks, *OPTIONS, *options]
    words += [f"--benchmark-json={place.with_suffix('.json')}"]
    words += [f"--law={file}" for file in side.laws]
    words += [f"--contender={name}" for name in side.names]
    words += ["--only-files"] * side.only
    log = stack.enter_context(place.with_suffix(".log").open("w", encoding="utf-8"))
    process = subprocess.Popen(
        words,
        cwd=side.path,
        env=variables,
        pass_fds=sockets,
        stdin=subprocess.DEVNULL,
        stdout=log,
        stderr=log,
        preexec_fn=confine if side.laws else None,
    )
    if side.laws:
        stack.callback(end_all, token)
    stack.callback(process.wait)
    stack.callback(process.kill)
    return TimedRun(process, Path(log.name), place.with_suffix(".json"))


def _wait_for(runs: list[TimedRun], report: Callable[[Progress], None]) -> int | None:
    """Wait for all processes; return the place of one that failed, the last one if all are silent."""
    while True:
        # First this, then the output: what a process says last is read before it is judged.
        have_ended = all(run.has_ended() for run in runs)
        timed = [run.hear() for run in runs]
        for progress in timed[-1]:
            report(progress)
        if have_ended:
            failed = [at for at, run in enumerate(runs) if run.has_failed()]
            return failed[0] if failed else None
        if time.monotonic() - max(run.heard for run in runs) > SILENT_S:
            return len(runs) - 1
        time.sleep(LOOK_S)
