"""A function asked in a process of its own: what it prints goes nowhere, and it may hang, exit or crash.

This file imports nothing of ours, and neither does the pytest plugin that loads it by its place: a project may have a
package `bench` of its own.
"""

from __future__ import annotations

import contextlib
import json
import mmap
import os
import signal
import struct
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

LIMIT_S = 60.0
"""Seconds on the wall for the whole audit: fifty times what a function of some microseconds takes."""
HANGS = 0.1
"""Share of the limit: a call that has lasted longer when time is up hangs; of shorter ones the audit is slow."""
CALLS = 6000
"""About how many times a function is asked."""
LOOK_S = 0.05
BOARD = struct.Struct("<3d18d")
"""What the process says of itself before each call: calls begun, whether one is under way, numbers of each orientation
(9 or 4), and the two orientations."""
REQUEST, ANSWER, STATE = "request.json", "answer.json", "state"
"""Files of the folder between the two processes."""


class NotAsked(Exception):
    """No report: the reason and the cure, in one sentence."""


def audit_apart(
    target: str,
    stated: dict[str, Any],
    limit_s: float = LIMIT_S,
    progress: Callable[[int], None] = lambda calls: None,
) -> dict[str, Any]:
    """Return the report on the function that the target names.

    Args:
        target: FILE.py:NAME, MODULE:NAME or LIBRARY.so:SYMBOL. stated: arguments of `bench.audit.audit`.
        limit_s: seconds on the wall. progress: called with the number of calls, some times a second.

    Returns:
        report: as `Report.as_dict` has it. text: all of it for people; head: its first lines; paragraphs: name of a
        fault -> text.

    Errors:
        NotAsked: nothing that can be asked is there, or it takes too long.
    """
    asked: dict[str, Any] = {"target": target, "stated": stated, "path": sys.path}
    with tempfile.TemporaryDirectory(prefix="orientation-audit-", ignore_cleanup_errors=True) as name:
        folder = Path(name)
        lost = ask(folder, asked, limit_s, progress)
        if lost:  # a process that has the function no more writes the report
            ask(folder, asked | {"lost": lost}, LIMIT_S, lambda calls: None)
        answer = folder / ANSWER
        said: dict[str, Any] = json.loads(answer.read_text("utf-8")) if answer.is_file() else {"refused": "no report"}
    if "refused" in said:
        raise NotAsked(said["refused"])
    return said


def ask(folder: Path, asked: dict[str, Any], limit_s: float, progress: Callable[[int], None]) -> dict[str, Any] | None:
    """Let one process do it; return how it was lost in a call, None if it has answered."""
    (folder / REQUEST).write_text(json.dumps(asked), "utf-8")
    (folder / STATE).write_bytes(bytes(BOARD.size))
    command = [sys.executable, "-P", str(Path(__file__).with_name("asked.py")), str(folder)]
    nowhere = subprocess.DEVNULL
    deadline, began, seen = time.monotonic() + limit_s, time.monotonic(), 0
    with (folder / STATE).open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as state:
        process = subprocess.Popen(command, stdin=nowhere, stdout=nowhere, stderr=nowhere, start_new_session=True)
        try:
            while process.poll() is None and time.monotonic() < deadline:
                calls = int(BOARD.unpack_from(state)[0])
                if calls != seen:
                    began, seen = time.monotonic(), calls
                    progress(calls)
                with contextlib.suppress(subprocess.TimeoutExpired):
                    process.wait(LOOK_S)
            code = process.poll()
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()
        calls, is_asking, count, *numbers = BOARD.unpack_from(state)
    if (folder / ANSWER).is_file():
        return None
    how = ending(code)
    if not calls and code is None:
        raise NotAsked(f"{asked['target']} was not loaded within {limit_s:g} s; correct what it does at its import, or "
                       f"give a longer --limit")  # fmt: skip
    if not calls:
        raise NotAsked(f"{asked['target']} ended the process while it was loaded ({how}); correct what it does there")
    lasted = time.monotonic() - began
    if code is None and not (is_asking and lasted > HANGS * limit_s):
        raise NotAsked(
            f"{asked['target']} is too slow: {int(calls):,} of about {CALLS:,} calls were done in {limit_s:g} s; give "
            f"--limit {CALLS / calls * limit_s * 1.5:.0f}, or a faster function"
        )
    size = int(count)
    pair = {"now": numbers[:size], "goal": numbers[9 : 9 + size]}
    if code is None:
        return {"fault": "hangs", "how": f"call {int(calls):,} had not returned after {lasted:.3g} s", **pair}
    return {"fault": "ends-process", "how": f"call {int(calls):,} ended the process ({how})", **pair}


def ending(code: int | None) -> str:
    """How a process ended, in a word or two."""
    if code is None:
        return "it did not end"
    return f"exit code {code}" if code >= 0 else signal.Signals(-code).name
