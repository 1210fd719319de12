"""Run a command of this program, write each change of its phase into a pipe, and die at one of its file operations.

Its words are PIPE FOLDER TABLES PHASE NUMBER WORDS: an open file descriptor, the command's --out, how many tables it
writes, and its words. Before operation NUMBER of PHASE below FOLDER the process kills itself; below zero it does not.
Its files and numba tell the phases of a run: start-up until plan.json is put in place; then parts; but
compiling while numba compiles, in both; merge from the first table until the last is in its place; then finish.
"""

import os
import runpy
import signal
import sys
from pathlib import Path
from typing import Any

from bench.engines import cache  # noqa: F401  before numba, which reads the folder of its cache once
from bench.studies.survival.killed import EVENTS, is_file_below

# isort: split
from numba.core import event

START, COMPILING, PARTS, MERGE, FINISH = "start-up", "compiling", "parts", "merge", "finish"


class Trace(event.Listener):
    """The phase that the process is in, and the number of its file operations there."""

    def __init__(self, pipe: int, out: Path, tables: int, phase: str, number: int):
        self.pipe, self.out, self.left, self.wanted, self.number = pipe, out, tables, phase, number
        self.seen, self.deep, self.phase, self.before = 0, 0, "", START

    def enter(self, phase: str) -> None:
        """Write a phase into the pipe if it is another than the last one."""
        if phase != self.phase:
            self.phase, self.seen = phase, 0
            os.write(self.pipe, f"{phase}\n".encode())

    def on_start(self, event: Any) -> None:
        """Enter the phase of compiling when numba begins; a function that it calls is compiled inside."""
        self.deep += 1
        if self.phase in (START, PARTS):
            self.before = self.phase
            self.enter(COMPILING)

    def on_end(self, event: Any) -> None:
        """Leave the phase of compiling when the outermost function is compiled."""
        self.deep -= 1
        if self.deep == 0 and self.phase == COMPILING:
            self.enter(self.before)

    def hear(self, name: str, arguments: tuple) -> None:
        """Note an audit event of Python: the phase that it begins, and the operation at which to die."""
        if self.phase == MERGE and self.left == 0:
            self.enter(FINISH)
        if name not in EVENTS or not str(arguments[0]).startswith(str(self.out)):
            return
        if name == "open" and not is_file_below(self.out, *arguments):
            return
        path = Path(str(arguments[1] if name == "os.rename" else arguments[0]))
        is_table = path.parent == self.out and ".parquet" in path.name
        if self.phase == PARTS and is_table:
            self.enter(MERGE)
        if self.phase == self.wanted:
            self.seen += 1
            if self.seen > self.number >= 0:
                os.kill(os.getpid(), signal.SIGKILL)
        os.write(self.pipe, b".\n")
        if name == "os.rename" and path == self.out / "plan.json":
            self.enter(PARTS)
        elif name == "os.rename" and is_table:
            self.left -= 1


if __name__ == "__main__":
    descriptor, folder, tables, phase, number, *words = sys.argv[1:]
    trace = Trace(int(descriptor), Path(folder), int(tables), phase, int(number))
    trace.enter(START)
    event.register("numba:compile", trace)
    sys.addaudithook(trace.hear)
    sys.argv[1:] = words
    runpy.run_module("bench", run_name="__main__")
