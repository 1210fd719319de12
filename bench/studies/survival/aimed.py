"""Kill a command in a phase that is named, give the same command again, and compare what it ends with."""

import contextlib
import os
import random
import select
import shutil
import signal
import subprocess
import sys
import time
from collections import Counter, defaultdict
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from bench.base.provenance import ROOT
from bench.studies.survival.killed import files_of, how_far
from bench.studies.survival.traced import START

SEED = 20260119
TRIES, EARLIER = 8, 0.7
"""A kill that comes when the phase is over, on a machine whose speed varies, is counted as missed and tried earlier."""


class Aim(NamedTuple):
    """A phase in which a command is killed.

    words: of the command, and {out} for its folder. within: the phases of its trace. by_operation: whether the moment
    is a file operation, not one in time. is_cold: whether nothing is compiled yet. program: what runs, if not this
    program; it writes no trace into the pipe, writes into `folder`, and is killed with all that it started.
    """

    phase: str
    words: str
    within: tuple[str, ...]
    by_operation: bool = False
    is_cold: bool = False
    program: Path | None = None
    folder: Path | None = None


class Watched(NamedTuple):
    """What was seen of a process: exit code, the last phase, seconds and file operations by phase."""

    code: int
    last: str
    spent_s: dict[str, float]
    operations: Counter[str]


class Try(NamedTuple):
    """A run of a command: the aim, its folder, the cache of compiled code, and the number of its tables."""

    aim: Aim
    out: Path
    cache: Path
    tables: int = 0

    def start(self, pipe: int = 0, number: int = -1) -> subprocess.Popen:
        """Start the command, with a trace if there is a pipe to write it into."""
        words = [word.format(out=self.out) for word in self.aim.words.split()]
        trace = ["bench.studies.survival.traced", str(pipe), str(self.out), str(self.tables), self.aim.within[0]]
        run = ["-m", *([*trace, str(number)] if pipe else ["bench"])]
        run = [str(self.aim.program)] if self.aim.program else run
        root = self.aim.program.parents[1] if self.aim.program else ROOT
        more = {"PYTHONPATH": str(root), "NUMBA_CACHE_DIR": str(self.cache), "PYTHONWARNINGS": "ignore"}
        quiet = subprocess.DEVNULL
        return subprocess.Popen(
            [sys.executable, *run, *words], cwd=root, env=os.environ | more, stdout=quiet, stderr=quiet,
            pass_fds=(pipe,) if pipe else (), start_new_session=True,
        )  # fmt: skip

    def watch(self, after_s: float | None = None, number: int = -1) -> Watched:
        """Run it and follow its trace; kill it when it has been so long in the phase, or at an operation of it."""
        reader, writer = os.pipe()
        process = self.start(writer, number)
        os.close(writer)
        spent_s, operations = defaultdict[str, float](float), Counter[str]()
        last, entered, is_over = self.aim.phase if self.aim.program else START, time.monotonic(), False
        with open(reader, "rb", buffering=0) as pipe:
            while not is_over:
                there = sum(spent_s[one] for one in self.aim.within) + time.monotonic() - entered
                waits = after_s is not None and last in self.aim.within
                if waits and there >= (after_s or 0.0):
                    after_s = None
                    with contextlib.suppress(ProcessLookupError):
                        (os.killpg if self.aim.program else os.kill)(process.pid, signal.SIGKILL)
                elif select.select([pipe], [], [], max(0.0, (after_s or 0.0) - there) if waits else None)[0]:
                    said = pipe.read(1 << 16).decode()
                    is_over = not said
                    for word in said.split("\n"):
                        operations[last] += word == "."
                        if len(word) > 1 and word != last:
                            now = time.monotonic()
                            spent_s[last] += now - entered
                            last, entered = word, now
        spent_s[last] += time.monotonic() - entered
        return Watched(process.wait(), last, spent_s, operations)

    def content(self) -> dict[str, str]:
        """Return the digest of every file that the command has written."""
        return files_of(self.aim.folder or self.out)


class Undisturbed(NamedTuple):
    """What a command writes if nothing kills it, and how it ran: with nothing compiled yet, and then again."""

    content: dict[str, str]
    cold: Watched
    warm: Watched
    tables: int


def leave_alone(aim: Aim, folder: Path, cache: Path) -> Undisturbed:
    """Run a command to its end, twice: the second time the number of its tables tells the merge from the end."""
    one = Try(aim, folder / f"{aim.phase}-cold", cache)
    cold = warm = one.watch()
    content = one.content()
    tables = 0 if aim.program else sum(name.endswith(".parquet") for name in content)
    if not aim.program:
        warm = Try(aim, folder / f"{aim.phase}-warm", cache, tables).watch()
    if cold.code or warm.code:
        raise RuntimeError(f"{aim.phase}: the command that nothing kills ends with {cold.code or warm.code}")
    return Undisturbed(content, cold, warm, tables)


def kill_evenly(
    aim: Aim, kills: int, wanted: Undisturbed, folder: Path, cache: Path, report: Callable[[dict], None]
) -> None:
    """Kill a command `kills` times, evenly spread over the phase; report each, with what the same command ends with."""
    chance, usual = random.Random(f"{SEED}{aim.phase}"), wanted.cold if aim.is_cold else wanted.warm
    seconds = sum(usual.spent_s.get(one, 0.0) for one in aim.within)
    operations = sum(usual.operations[one] for one in aim.within)
    for k in range(kills):
        for missed in range(TRIES):
            at = (k + chance.random()) / kills * EARLIER**missed
            kept = folder / f"{aim.phase}-cache-{k}-{missed}" if aim.is_cold else cache
            one = Try(aim, folder / f"{aim.phase}-{k}-{missed}", kept, wanted.tables)
            if aim.folder:
                shutil.rmtree(aim.folder.parent, ignore_errors=True)
            number = int(at * operations) if aim.by_operation else -1
            seen = one.watch(None if aim.by_operation else at * seconds, number)
            if seen.code == -signal.SIGKILL and seen.last in aim.within:
                break
        else:
            raise RuntimeError(f"{aim.phase}: {TRIES} kills came too late; give the machine less to do")
        far = how_far(one.out)
        code = one.start().wait()
        row = {"phase": aim.phase, "share_of_phase": round(at, 3), "units_done": far["parts"], "missed": missed}
        row |= {"tables_done": sum(name.endswith(".parquet") for name in far["names"])}
        report({**row, "went_on": code == 0, "same": one.content() == wanted.content})
