"""The process of one side (`side.py`) as its parent sees it."""

import contextlib
import json
import os
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from bench.errors import Incompatible
from bench.regression.revisions.machine import environment

SILENT_S = 1200.0
"""On the wall, from line to line: a side that says nothing for so long is ended. Compiling all laws takes a tenth."""

PROGRAM = Path(__file__).with_name("side.py")


class SideFailed(Incompatible):
    """A side's process ended of itself; `at` is its place among those that were started."""

    def __init__(self, at: int, reason: str):
        super().__init__(reason)
        self.at = at


class Compiled(NamedTuple):
    """What a side can time: its machine code lies under `file`, if it is a law; 0 ticks if it cannot be timed.

    code: digest of the machine code. symbol: the function's name in it.
    """

    name: str
    what: str
    ticks: int
    code: str
    symbol: str

    @property
    def file(self) -> str:
        """Name of the file that holds its machine code."""
        return f"{self.name.replace('/', '+')}.o"


class Laws(NamedTuple):
    """What a side is asked for: a user's files, whether nothing but those, and whether engines too.

    names: nothing but these laws; none: all.
    """

    files: tuple[Path, ...] = ()
    only: bool = False
    engines: bool = True
    names: tuple[str, ...] = ()


class Process:
    """A running side; use `running`."""

    def __init__(self, at: int, checkout: Path, laws: Laws, objects: Path, errors: Any):
        self.at, self.checkout, self.laws, self.objects, self.errors = at, checkout, laws, objects, errors
        self.popen = subprocess.Popen(
            [sys.executable, "-P", str(PROGRAM)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=errors,
            text=True,
            cwd=checkout,
            env=environment(checkout),
            start_new_session=True,  # Ctrl-C is the parent's to handle
        )
        files = [str(path) for path in laws.files]
        self.say(laws=files, only=laws.only, engines=laws.engines, names=laws.names, objects=str(objects))
        self.benchmarks: dict[str, Compiled] = {}
        self.sources = ""

    def say(self, **words: Any) -> None:
        """One line to the side."""
        assert self.popen.stdin is not None
        with contextlib.suppress(BrokenPipeError):  # `hear` then says why it has gone
            self.popen.stdin.write(json.dumps(words) + "\n")
            self.popen.stdin.flush()

    def hear(self) -> dict[str, Any]:
        """The side's next line.

        Errors:
            SideFailed: it ended; the message has its last words.
        """
        assert self.popen.stdout is not None
        too_long = threading.Timer(SILENT_S, self.popen.kill)
        too_long.start()
        line = self.popen.stdout.readline()
        too_long.cancel()
        if not line:
            raise SideFailed(self.at, f"laws of {self.checkout} cannot be compiled and timed ({self._last_words()})")
        return json.loads(line)

    def _last_words(self) -> str:
        self.popen.wait()
        self.errors.seek(0)
        lines = [line.strip() for line in self.errors.read().decode(errors="replace").splitlines() if line.strip()]
        return lines[-1] if lines else f"it ended with {self.popen.returncode}"

    def end(self) -> None:
        """End it, whatever it is doing."""
        self.popen.kill()
        with contextlib.suppress(BrokenPipeError):
            self.popen.communicate()

    def ready(self) -> None:
        """Wait until all is compiled."""
        heard = self.hear()
        self.benchmarks = {one["name"]: Compiled(**one) for one in heard["benchmarks"]}
        self.sources = heard["sources"]


@contextlib.contextmanager
def running(checkouts: list[tuple[Path, Laws]]) -> Iterator[list[Process]]:
    """A process for each checkout, all of which compile at once; they end with the block.

    Errors:
        SideFailed: one cannot import or compile its laws.
    """
    with contextlib.ExitStack() as stack:
        processes = []
        for at, (checkout, laws) in enumerate(checkouts):
            objects = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="orientation-bench-")))
            errors = stack.enter_context(tempfile.TemporaryFile())
            process = Process(at, Path(checkout), laws, objects, errors)
            stack.callback(process.end)
            processes.append(process)
        for process in processes:
            process.ready()
        yield processes


def cores() -> list[int]:
    """Cores that a round may run on; a single 0 where they cannot be chosen."""
    return sorted(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else [0]
