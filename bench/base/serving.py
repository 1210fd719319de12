"""Answer what another process asks: the side of foreign code (isolated.py says what both do)."""

import contextlib
import functools
import json
import math
import os
import resource
import signal
import socket
import sys
import time
from collections.abc import Callable
from typing import NoReturn

from bench.base.isolated import (
    CRASHED,
    HUNG,
    KILLED,
    PROGRESS,
    Line,
    NoAnswer,
    TimeLimits,
    describe_exit,
    describe_use,
    describe_wait,
    read_answer,
    write_answer,
)

ENDING_S = 0.5
"""On the wall, from the end of a fork's line to its exit code."""

SIGKILL_S = 1
"""Processor time from SIGXCPU at a limit to the SIGKILL that nothing ignores."""


def serve(make: Callable[[dict, Line], bytes]) -> None:
    """Answer on the line of this process's first argument until the process that asks hangs up.

    make: returns the answer to a request; it is given the line too, for `send_progress` and for
    forks of its own.
    """
    line = Line(socket.socket(fileno=int(sys.argv[1])))
    while True:
        try:
            request = json.loads(line.receive())
            line.send(write_answer(functools.partial(_answer, make, request, line)))
        except (EOFError, ConnectionError):
            sys.exit(1)


def _answer(make: Callable[[dict, Line], bytes], request: dict, line: Line) -> bytes:
    limits = TimeLimits(*request["limits"])
    if request["in_fork"]:
        # What each fork costs this process must not add up to the limit of an earlier request.
        lift_processor_limit()
        return answer_in_fork(lambda: make(request, line), limits, line)
    limit_processor_time(limits.processor_s)
    return make(request, line)


def send_progress(line: Line, number: int) -> None:
    """Say how much is done, before the answer."""
    line.send(PROGRESS + str(number).encode())


def answer_in_fork(
    make: Callable[[], bytes],
    limits: TimeLimits,
    line: Line,
    look: Callable[[], object] = lambda: None,
) -> bytes:
    """Return what `make` returns in a fork of this process; Refused or NoAnswer if it does not.

    Args:
        make: What is called there.
        limits: Of the call.
        line: To the process that asks: the fork does not outlast it.
        look: Is called every LOOK_S here.
    """
    ours, theirs = (Line(end) for end in socket.socketpair())
    pid = os.fork()
    if not pid:
        line.close()
        ours.close()
        _answer_and_exit(make, limits.processor_s, theirs)
    theirs.close()
    with contextlib.suppress(OSError):
        os.setpgid(pid, pid)
    endings: list[tuple[int, float]] = []

    def has_ended(options: int = os.WNOHANG) -> bool:
        if not endings:
            ended, status, used = os.wait4(pid, options)
            if ended:
                endings.append((os.waitstatus_to_exitcode(status), used.ru_utime + used.ru_stime))
        return bool(endings)

    def has_no_more_to_say() -> bool:
        if line.is_readable():
            # The process that asks says nothing before it has its answer: this is its end.
            raise EOFError
        look()
        return has_ended()

    answer: bytes | None = b""
    try:
        answer = ours.receive(limits.wall_s, has_ended=has_no_more_to_say)
    except TimeoutError:
        answer = None
    except (EOFError, OSError):
        deadline = time.monotonic() + ENDING_S
        # So that its exit code is its own.
        while not has_ended() and time.monotonic() < deadline:
            time.sleep(0.001)
    finally:
        ours.close()
        with contextlib.suppress(ProcessLookupError):
            os.killpg(pid, signal.SIGKILL)
        has_ended(options=0)
    if answer:
        return read_answer(answer)
    if answer is None:
        raise NoAnswer(HUNG, describe_wait(limits.wall_s))
    [(code, used_s)] = endings
    # The system counts this time in its ticks, so that the last of them may be in part unused. A
    # SIGKILL that comes before has another reason, such as want of memory.
    at_limit_s = {-signal.SIGXCPU: 0.0, -signal.SIGKILL: SIGKILL_S / 2}
    if code in at_limit_s and used_s >= limits.processor_s + at_limit_s[code]:
        raise NoAnswer(HUNG, describe_use(limits.processor_s))
    ending = describe_exit(code)
    fate = KILLED if code == -signal.SIGKILL else CRASHED
    raise NoAnswer(fate, f"it ended its process, {ending}", ending)


def _answer_and_exit(make: Callable[[], bytes], processor_s: float, line: Line) -> NoReturn:
    try:
        os.setpgid(0, 0)
        limit_processor_time(processor_s, is_last=True)
        line.send(write_answer(make))
        os._exit(0)
    finally:
        # What is no Exception, as SystemExit: the code wants to leave.
        os._exit(1)


def limit_processor_time(processor_s: float, is_last: bool = False) -> None:
    """End this process with SIGXCPU when it has used so many seconds more, rounded up.

    is_last: no other limit follows, so that SIGKILL comes SIGKILL_S later.
    """
    used = resource.getrusage(resource.RUSAGE_SELF)
    _, most = resource.getrlimit(resource.RLIMIT_CPU)
    ends = math.ceil(used.ru_utime + used.ru_stime + processor_s)
    resource.setrlimit(resource.RLIMIT_CPU, (ends, ends + SIGKILL_S if is_last else most))


def lift_processor_limit() -> None:
    """Let this process use as much processor time as it was allowed when it began."""
    _, most = resource.getrlimit(resource.RLIMIT_CPU)
    resource.setrlimit(resource.RLIMIT_CPU, (most, most))
