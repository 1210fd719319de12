"""Time base and head in turn, and judge: slower by more than a tenth, beyond chance, twice.

Each side is a process of `timed.py`. Their rounds alternate, so a slow moment of the machine meets both. Two conditions
must hold: the Mann-Whitney test of the rounds rejects "not slower" at P, and the median ratio of neighbouring rounds is
above RATIO, which keeps out what is real but small. A second run of the suspects, in new processes, must agree.

Limitations: a law that is slower by less than a tenth is not found, unless it has more operations.
"""

import contextlib
import json
import os
import secrets
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import IO, Any, NamedTuple

import numpy as np

from bench.base.errors import Incompatible
from bench.base.files import read_json
from bench.base.processes import law_environment
from bench.law.contenders.law_process import confine
from bench.regression.revisions.timed import OTHER_ENDED

P, RATIO = 0.002, 1.10  # of thirty laws and no change, one comparison in seventeen has a p below P by chance
ROUNDS = 60  # the interval of a median covers the 23rd to 38th; a round takes from 0.3 ms to 10 ms
SAME, SLOWER, FASTER = "same", "slower", "faster"
PROGRAM = Path(__file__).with_name("timed.py")
LONGEST_S = 1800.0  # on the wall, until a process is ended; compiling all laws takes a tenth of it


class Side(NamedTuple):
    """A side: sources, a user's law files, whether only those count, benchmarks to time (none: all), name, digest."""

    path: Path
    laws: tuple[Path, ...] = ()
    only: bool = False
    names: tuple[str, ...] = ()
    name: str = ""
    digest: str = ""

    @property
    def is_new(self) -> bool:
        """Return whether there is nothing to compare: none of the law files is there yet."""
        return self.only and not self.laws


class Timed(NamedTuple):
    """Head over base: the median ratio of neighbouring rounds with its 95 % interval, the one-sided p, and a verdict.

    confirmed: whether a second run agreed with a first verdict other than "same"; None if there was no second run.
    """

    name: str
    ratio: float
    low: float
    high: float
    p: float
    rounds: int
    verdict: str
    confirmed: bool | None = None


class SideFailed(Incompatible):
    """A process ended with an error; `at` is its place among those that were started."""

    def __init__(self, at: int, reason: str):
        super().__init__(reason)
        self.at = at


def run_benchmarks(sides: list[Side], words: tuple[str, ...] = (), rounds: int = ROUNDS) -> list[dict[str, Any]]:
    """Run the benchmarks of one side, or of two in turn, with words for pytest; return pytest-benchmark's files."""
    with contextlib.ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="orientation-bench-")))
        ends = [stack.enter_context(end) for end in socket.socketpair()]
        processes = []
        for at, side in enumerate(sides):
            log = stack.enter_context(open(folder / f"{at}.log", "w", encoding="utf-8"))
            asked = {"laws": list(map(str, side.laws)), "only": side.only, "names": side.names, "rounds": rounds}
            asked |= {"words": [*words, f"--benchmark-json={folder / f'{at}.json'}"]}
            asked |= {"line": ends[at].fileno() if len(sides) > 1 else None, "begins": at == 0}
            processes.append(_start(side, asked, log, folder / f"compiled-{at}"))
            stack.callback(processes[-1].kill)
        for end in ends:
            end.close()
        if (failed := _wait_for(processes)) is not None:
            lines = (folder / f"{failed}.log").read_text(encoding="utf-8", errors="replace").strip().splitlines()
            reason = lines[-1] if lines else f"it ended with {processes[failed].poll()}"
            raise SideFailed(failed, f"laws of {sides[failed].path} cannot be compiled and timed ({reason})")
        files = [folder / f"{at}.json" for at in range(len(sides))]
        return [read_json(file) if file.is_file() else {"benchmarks": []} for file in files]


def _start(side: Side, asked: dict[str, Any], log: IO[str], compiled: Path) -> subprocess.Popen:
    """Start the process of a side; compiled: a folder for what it compiles beside users' laws."""
    checkout = side.path
    inherited_variables = dict(os.environ)
    if side.laws:
        # A user's law may change what is compiled beside it, and an older revision keeps that: so it is kept nowhere.
        inherited_variables = law_environment(secrets.token_hex(8)) | {"NUMBA_CACHE_DIR": str(compiled)}
    # under variables of pytest-xdist, pytest-benchmark would switch itself off
    ours = {name: value for name, value in inherited_variables.items() if not name.startswith("PYTEST_")}
    more = {"PYTHONPATH": str(checkout), "PYTHONHASHSEED": "0", "ORIENTATION_BENCH_TIMED": json.dumps(asked)}
    words, inherited = [sys.executable, "-P", str(PROGRAM)], [asked["line"]] if asked["line"] else []
    how: dict[str, Any] = {"pass_fds": inherited, "stdout": log, "stderr": log, "preexec_fn": confine}
    return subprocess.Popen(words, cwd=checkout, env=ours | more, **how)


def _wait_for(processes: list[subprocess.Popen]) -> int | None:
    """Wait for all processes; return the place of the one that failed, the last one's if they hang."""
    end = time.monotonic() + LONGEST_S
    for process in processes:
        try:
            process.wait(max(end - time.monotonic(), 0.0))
        except subprocess.TimeoutExpired:
            return len(processes) - 1
    codes = [process.returncode for process in processes]
    return next((at for at, code in enumerate(codes) if code not in (0, OTHER_ENDED)), None)


def judge_rounds(name: str, base: np.ndarray, head: np.ndarray) -> Timed:
    """Return the verdict of one run, of one time a round each in the order in which they were taken."""
    from scipy.stats import mannwhitneyu

    from bench.running.timing.ratios import ratio  # both are slow to import

    middle = ratio(head, base)
    slower, faster = (float(mannwhitneyu(head, base, alternative=side).pvalue) for side in ("greater", "less"))
    is_slower, is_faster = slower < P and middle.value > RATIO, faster < P and middle.value < 1.0 / RATIO
    verdict = SLOWER if is_slower else FASTER if is_faster else SAME
    return Timed(name, *middle, min(slower, faster), len(base), verdict)


def judge_files(*files: dict[str, Any]) -> dict[str, Timed]:
    """Return the verdict of one run by name, of base's and head's files of pytest-benchmark."""
    rounds = [
        {one["param"]: np.array(one["stats"]["data"]) / one["extra_info"]["ticks"] for one in file["benchmarks"]}
        for file in files
    ]
    return {name: judge_rounds(name, *(one[name] for one in rounds)) for name in rounds[0]}


def confirm(first: Timed, second: Timed) -> Timed:
    """Return the first verdict if the second agrees, else "same", with the second's numbers, which nobody picked."""
    agrees = second.verdict == first.verdict
    return second._replace(verdict=first.verdict if agrees else SAME, confirmed=agrees)


def compare_times(
    base: Side, head: Side, report: Callable = lambda *_: None, rounds: int = ROUNDS
) -> tuple[list[dict[str, Any]], dict[str, Timed]]:
    """Time both sides, and once more what differs; return the two files of the first run, and verdicts by name."""
    report("compiling and timing")
    files = run_benchmarks([base, head], rounds=rounds)
    times = judge_files(*files)
    suspects = tuple(name for name, one in times.items() if one.verdict != SAME)
    if suspects:
        report("timing once more what differs")
        again = run_benchmarks([side._replace(names=suspects) for side in (base, head)], rounds=rounds)
        times |= {name: confirm(times[name], one) for name, one in judge_files(*again).items()}
    return files, times
