"""The process that audits a function for another one (apart.py): a fork of it calls the function.

This process keeps our modules, so that it can say which call the function did not come back from.
The fork gives their names free: the function may be of another package with our name.
"""

import json
import mmap
import os
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from bench.audit.apart import CALLS
from bench.audit.convention import Stated
from bench.audit.examine import examine, report_lost
from bench.audit.examined import ENDS, HANGS, Lost
from bench.audit.faults import every_fault
from bench.audit.load import load
from bench.audit.report import Report, paragraph
from bench.base.errors import BadFunction, BenchError
from bench.base.isolated import (
    Line,
    NoAnswer,
    TimeLimits,
    answer_in_fork,
    send_progress,
    serve,
)

LONG = 0.1
"""Share of the limit: a call that has lasted longer when time is up hangs; of shorter ones the audit is slow."""

BEGUN, ENDED, SIZE, NOW, GOAL = 0, 1, 2, slice(3, 12), slice(12, 21)
"""Places of numbers on the board: calls begun and ended, size of an orientation, the two of a call."""


class Board:
    """What this process and the fork see of the calls, and when this one saw it.

    Attributes:
        numbers: In memory that both share; see BEGUN.
        line: To the process that asks for the audit.
        seen: Calls begun, at the last look.
        began_s: When the last call was first seen [s, of time.monotonic].
    """

    def __init__(self, line: Line):
        self.numbers = np.frombuffer(mmap.mmap(-1, 8 * GOAL.stop))
        self.line = line
        self.seen = 0
        self.began_s = time.monotonic()

    def look(self) -> None:
        """Send the number of calls if there are more than at the last look."""
        begun = int(self.numbers[BEGUN])
        if begun != self.seen:
            self.seen = begun
            self.began_s = time.monotonic()
            send_progress(self.line, begun)

    def wrap(self, function: Callable) -> Callable:
        """Return the function, with a note of what it is given before each call, and of its end."""
        numbers = self.numbers

        def call(now: np.ndarray, goal: np.ndarray) -> Any:
            numbers[SIZE] = now.size
            numbers[NOW][: now.size] = now.ravel()
            numbers[GOAL][: goal.size] = goal.ravel()
            numbers[BEGUN] += 1.0
            try:
                return function(now, goal)
            finally:
                numbers[ENDED] += 1.0

        return call


def answer_request(request: dict[str, Any], line: Line) -> bytes:
    """Return the report as JSON; BadFunction if the function cannot be audited."""
    # Of modules whose names the fork gives free.
    every_fault()
    board = Board(line)
    processor_s, _ = request["limits"]
    limits = TimeLimits(processor_s, request["limit_s"])
    try:
        return answer_in_fork(lambda: audit_here(request, board), limits, line, board.look)
    except NoAnswer as error:
        lost = find_lost_call(request, board, error.ending)
    return describe_report(request["target"], report_lost(request["target"], lost))


def find_lost_call(request: dict[str, Any], board: Board, ending: str) -> Lost:
    """Return the call that did not come back; BadFunction if none explains the end of the fork.

    ending: how the fork ended; empty if time was up.
    """
    target = request["target"]
    limit_s = request["limit_s"]
    lasted_s = time.monotonic() - board.began_s
    numbers = board.numbers
    calls = int(numbers[BEGUN])
    if not calls:
        happened = f"did not return within {limit_s:g} s (--limit)"
        if ending:
            happened = f"ended the process ({ending})"
        raise BadFunction(
            f"the import of {target} {happened}; correct what it does while it is loaded"
        )
    is_within_a_call = numbers[BEGUN] > numbers[ENDED] and lasted_s > LONG * limit_s
    if not ending and not is_within_a_call:
        raise BadFunction(
            f"{target} is too slow: {calls:,} of about {CALLS:,} calls were done in {limit_s:g} s; "
            f"give --limit {CALLS / calls * limit_s * 1.5:.0f}, or a faster function"
        )
    size = int(numbers[SIZE])
    shape = (3, 3) if size == 9 else (-1,)
    now = numbers[NOW][:size].reshape(shape)
    goal = numbers[GOAL][:size].reshape(shape)
    if ending:
        return Lost(ENDS, f"call {calls:,} ended the process ({ending})", now, goal)
    return Lost(HANGS, f"call {calls:,} had not returned after {lasted_s:.3g} s", now, goal)


def audit_here(request: dict[str, Any], board: Board) -> bytes:
    """Call the function in this process, and return the report as JSON."""
    target = request["target"]
    ours = (__package__ or "").partition(".")[0]
    for name in list(sys.modules):
        if name.partition(".")[0] == ours:
            del sys.modules[name]
    place = target.rpartition(":")[0]
    beside = [str(Path(place).resolve().parent)] if place.endswith(".py") else []
    sys.path[:] = [*beside, os.getcwd(), *request["path"]]
    loaded: list[Callable] = []

    def load_again() -> Callable:
        sys.modules.pop(place, None)
        try:
            loaded.append(load(target))
        except BadFunction:
            # A module that can be imported only once is called without a new import.
            if not loaded:
                raise
        return loaded[-1]

    allowed = tuple(request["stated"].get("allow", ()))
    try:
        stated = Stated(**request["stated"] | {"allow": allowed})
        report = examine(load_again(), stated, target, load_again, board.wrap)
        return describe_report(target, report)
    except BenchError:
        raise
    except BaseException as error:
        reason = f"the audit itself failed ({type(error).__name__}: {error}); report this"
        raise BadFunction(reason) from error


def describe_report(target: str, report: Report) -> bytes:
    """Return a report as `audit_apart` does, as JSON."""
    paragraphs = {}
    for finding in report.findings:
        if finding.is_fault:
            paragraphs[finding.fault.name] = paragraph(report, finding)
    content = {
        "report": report.as_dict(),
        "text": report.text(),
        "head": report.head(),
        "paragraphs": paragraphs,
    }
    return json.dumps(content).encode()


if __name__ == "__main__":
    serve(answer_request)
