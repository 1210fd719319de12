"""The process that audits a function for another (apart.py): it forks, and the child calls the function.

The parent keeps our modules, so that it can say how the child ended. The child gives their names free: the function may
be of another package with our name.
"""

import contextlib
import json
import mmap
import os
import signal
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import IO, Any, NoReturn

import numpy as np

from bench.audit.apart import CALLS
from bench.audit.convention import Stated
from bench.audit.examine import examine, report_lost
from bench.audit.examined import ENDS, HANGS, Lost
from bench.audit.faults import every_fault
from bench.audit.load import load
from bench.audit.report import Report, paragraph
from bench.base.errors import BadFunction, BenchError

LONG = 0.1
"""Share of the limit: a call that has lasted longer when time is up hangs; of shorter ones the audit is slow."""
LOOK_S = 0.05
BEGUN, ENDED, SIZE, NOW, GOAL = 0, 1, 2, slice(3, 12), slice(12, 21)
"""Places on the board that both processes see: calls begun and ended, numbers of an orientation, the two of a call."""


def main() -> None:
    """Print the numbers of calls, then the answer, each a line of JSON."""
    request = json.loads(sys.argv[1])
    try:
        said = answer_for(request)
    except BenchError as error:
        said = {"refused": str(error)}
    print(json.dumps(said), flush=True)


def answer_for(request: dict[str, Any]) -> dict[str, Any]:
    """Return what the child has written, or the report on how it ended; BadFunction if no call explains that."""
    every_fault()  # of modules whose names the child gives free
    board = np.frombuffer(mmap.mmap(-1, 8 * GOAL.stop))
    with tempfile.TemporaryFile() as answer:
        child = os.fork()
        if not child:
            audit_and_exit(request, board, answer)
        os.setpgid(child, child)
        code, lasted = watch(child, request["limit_s"], board)
        answer.seek(0)
        if code == 0 and (text := answer.read()):
            return dict(json.loads(text))
    lost = find_lost_call(request, board, code, lasted)
    return describe_report(request["target"], report_lost(request["target"], lost))


def watch(child: int, limit_s: float, board: np.ndarray) -> tuple[int | None, float]:
    """Print how many calls have begun; return the exit code, None if time is up, and seconds since the last call."""
    seen, code = 0.0, None
    began = time.monotonic()
    deadline = began + limit_s
    try:
        while code is None and time.monotonic() < deadline:
            time.sleep(LOOK_S)
            if board[BEGUN] != seen:
                seen, began = board[BEGUN], time.monotonic()
                print(int(seen), flush=True)
            ended, status = os.waitpid(child, os.WNOHANG)
            code = os.waitstatus_to_exitcode(status) if ended else None
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(child, signal.SIGKILL)
    return code, time.monotonic() - began


def find_lost_call(request: dict[str, Any], board: np.ndarray, code: int | None, lasted: float) -> Lost:
    """Return the call that did not come back."""
    target, limit_s, calls, size = request["target"], request["limit_s"], int(board[BEGUN]), int(board[SIZE])
    how = "" if code is None else f"exit code {code}" if code >= 0 else signal.Signals(-code).name
    if not calls:
        happened = f"ended the process ({how})" if how else f"did not return within {limit_s:g} s (--limit)"
        raise BadFunction(f"the import of {target} {happened}; correct what it does while it is loaded")
    if not how and not (board[BEGUN] > board[ENDED] and lasted > LONG * limit_s):
        raise BadFunction(
            f"{target} is too slow: {calls:,} of about {CALLS:,} calls were done in {limit_s:g} s; give --limit "
            f"{CALLS / calls * limit_s * 1.5:.0f}, or a faster function"
        )
    now, goal = (board[place][:size].reshape((3, 3) if size == 9 else -1) for place in (NOW, GOAL))
    if how:
        return Lost(ENDS, f"call {calls:,} ended the process ({how})", now, goal)
    return Lost(HANGS, f"call {calls:,} had not returned after {lasted:.3g} s", now, goal)


def audit_and_exit(request: dict[str, Any], board: np.ndarray, answer: IO[bytes]) -> NoReturn:
    """Call the function in this process, write the report, and exit without waiting for its threads."""
    target, path = request["target"], request["path"]
    nowhere = os.open(os.devnull, os.O_RDWR)
    for stream in range(3):
        os.dup2(nowhere, stream)
    ours = __name__.partition(".")[0]
    for name in [name for name in sys.modules if name.partition(".")[0] == ours]:
        del sys.modules[name]
    place = target.rpartition(":")[0]
    sys.path[:] = [*([str(Path(place).resolve().parent)] if place.endswith(".py") else []), os.getcwd(), *path]
    loaded: list[Callable] = []

    def fresh() -> Callable:
        sys.modules.pop(place, None)
        try:
            loaded.append(load(target))
        except BadFunction:
            if not loaded:
                raise  # else a module that can be imported only once is called without a new import
        return loaded[-1]

    try:
        allowed = tuple(request["stated"].get("allow", ()))
        stated = Stated(**request["stated"] | {"allow": allowed})
        said = describe_report(target, examine(fresh(), stated, target, fresh, lambda call: note_calls(call, board)))
    except BenchError as error:
        said = {"refused": str(error)}
    except BaseException as error:
        said = {"refused": f"the audit itself failed ({type(error).__name__}: {error}); report this"}
    answer.write(json.dumps(said).encode())
    answer.flush()
    os._exit(0)


def note_calls(function: Callable, board: np.ndarray) -> Callable:
    """Return the function, with a note of what it is given before each call, and of its end."""

    def call(now: np.ndarray, goal: np.ndarray) -> Any:
        board[SIZE], board[NOW][: now.size], board[GOAL][: goal.size] = now.size, now.ravel(), goal.ravel()
        board[BEGUN] += 1.0
        try:
            return function(now, goal)
        finally:
            board[ENDED] += 1.0

    return call


def describe_report(target: str, report: Report) -> dict[str, Any]:
    """Return a report as `audit_apart` does."""
    paragraphs = {one.fault.name: paragraph(report, one) for one in report.findings if one.is_fault}
    return {"report": report.as_dict(), "text": report.text(), "head": report.head(), "paragraphs": paragraphs}
