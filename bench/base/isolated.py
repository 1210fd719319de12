"""A process of its own for code that is not ours: a user's law, or a function that is audited.

The process that asks starts a module of ours, and ends it with all that it has started:

    with IsolatedProcess("bench.export.apart") as process:
        content = process.ask({"language": "c"}, TimeLimits(processor_s=60.0, wall_s=300.0))

That module answers one request after the other (serving.py):

    if __name__ == "__main__":
        serve(make_answer)

Both sides speak in messages: four bytes of length, then the content. A request is JSON. An answer
is a sign of one byte, and what was asked for or the reason why it did not come. `ask` returns the
first and raises the second. So does `answer_in_fork`, which makes an answer in a fork of the
process that serves: what hangs, crashes or exits there costs that answer alone.

Nothing of the foreign code runs in the process that asks. What it prints goes nowhere, its memory
has a limit, its temporary files go with it, and whatever it forks is found again by a token in its
environment, if the system shows it (Linux). Between the two runs a guard, which is the parent that
the foreign code sees. It is this module, started with MODULE DESCRIPTOR BYTES: it runs MODULE in a
fork, ends as that does, and ends it when the line of this descriptor hangs up.
"""

import contextlib
import json
import math
import os
import runpy
import secrets
import select
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple, NoReturn

from bench.base.errors import BenchError
from bench.base.processes import LAW_PROCESS, law_environment, module_command

FOLDER = "orientation-bench-law-"
"""How the names of folders for temporary files begin."""

PROCESSES = Path("/proc")

MEMORY, MAPPED, FILE = 4 << 30, 8 << 30, 1 << 28
"""Bytes of data that a process may have: compiling all engines takes 1.6e9, most of which is never
touched; of all that it maps, shared memory too; and of a file that it writes, in shared memory too.
"""

UNLIMITED = 0
"""In place of MAPPED, for code that may use a graphics card: its driver maps more than there is."""

LENGTH = struct.Struct("!I")
PIECE, MOST, SHOWN = 1 << 20, 1 << 28, 400
"""Bytes that are read at once, bytes of a message, and letters of a reason that are shown."""

LOOK_S = 0.2
"""How often it is looked whether a silent process is there still."""

HALTS_S = 60.0
"""On the wall, from the begin of a message to its end: foreign code may write to the line itself."""

FORWARD_S = 60.0
"""On the wall, for a busy machine to pass on what a fork has answered or that its time is up."""

CLOSING_S = 5.0
"""On the wall, from the end of the line to that of the process."""

CRASHED, HUNG, KILLED, FORGED = "crashed", "hung", "killed", "forged"
"""Why there is no answer: the code raised or ended its process; it did not return in time; something
ended its process by SIGKILL, perhaps the system for want of memory; what came was no answer."""

DONE, REFUSED, PROGRESS = b"+", b"?", b"~"
SIGNS = {CRASHED: b"!", HUNG: b".", KILLED: b"-"}
"""First bytes of an answer: what was asked for; the caller's mistake; a number of what is done so
far, before the answer itself; or why there is none."""


class TimeLimits(NamedTuple):
    """How long an answer may take.

    Attributes:
        processor_s: Of processor time, which no other load on the machine shortens.
        wall_s: On the wall, for code that waits.
    """

    processor_s: float
    wall_s: float


class Refused(BenchError):
    """The caller's mistake, in the words of the other process."""


class NoAnswer(Exception):
    """What was asked for did not come.

    Attributes:
        fate: CRASHED, HUNG, KILLED or FORGED.
        ending: How a process ended, such as "SIGSEGV"; empty if none has.
        is_over: Whether the process that was asked is gone, or must go.
    """

    def __init__(self, fate: str, reason: str, ending: str = "", is_over: bool = False):
        super().__init__(reason)
        self.fate = fate
        self.ending = ending
        self.is_over = is_over


class Line:
    """One end of the line between two processes."""

    def __init__(self, end: socket.socket):
        self.socket = end
        self._poll = select.poll()
        self._poll.register(end, select.POLLIN)

    def close(self) -> None:
        """Hang up."""
        self.socket.close()

    def send(self, content: bytes) -> None:
        """Send a message; OSError if nobody listens any more."""
        self.socket.sendall(LENGTH.pack(len(content)) + content)

    def is_readable(self, wait_s: float = 0.0) -> bool:
        """Return whether something has come within the time, or the other side has hung up."""
        return bool(self._poll.poll(1e3 * wait_s))

    def receive(
        self,
        wall_s: float = math.inf,
        most: int = MOST,
        has_ended: Callable[[], bool] = lambda: False,
    ) -> bytes:
        """Return the next message.

        Args:
            wall_s: How long to wait.
            most: Bytes that it may have.
            has_ended: Is called every LOOK_S and tells whether the other process has ended: what it has
                forked may hold the line still.

        Errors:
            TimeoutError: Nothing came for so long, or the message halted midway.
            EOFError, OSError: The other side has hung up or ended.
            NoAnswer: It is too long; FORGED.
        """
        deadline = time.monotonic() + wall_s
        message = bytearray()
        size = LENGTH.size
        while len(message) < size:
            self._wait(deadline, has_ended)
            piece = self.socket.recv(min(size - len(message), PIECE))
            if not piece:
                raise EOFError
            if not message:
                deadline = min(deadline, time.monotonic() + HALTS_S)
            message += piece
            if len(message) == LENGTH.size:
                [length] = LENGTH.unpack(message)
                size += length
                if length > most:
                    reason = f"it gave back {length:,} bytes, and may give {most:,}"
                    raise NoAnswer(FORGED, reason, is_over=True)
        return bytes(message[LENGTH.size :])

    def _wait(self, deadline: float, has_ended: Callable[[], bool]) -> None:
        while True:
            left_s = deadline - time.monotonic()
            if self.is_readable(max(0.0, min(LOOK_S, left_s))):
                return
            if has_ended() and not self.is_readable():
                raise EOFError
            if left_s < 0.0:
                raise TimeoutError


class IsolatedProcess(contextlib.AbstractContextManager):
    """A process that runs a module of ours, which serves, and the line to it.

    Attributes:
        line: Our end of the line.
        token: Value of a variable in the environment of all that the process starts.
        folder: Of its temporary files.
        process: The guard.
    """

    def __init__(self, module: str, mapped: int = MAPPED):
        """Start it; mapped: bytes that it may map, or UNLIMITED."""
        ours, theirs = socket.socketpair()
        self.line = Line(ours)
        self.token = secrets.token_hex(8)
        self.folder = tempfile.TemporaryDirectory(prefix=FOLDER, ignore_cleanup_errors=True)
        environment = law_environment(self.token)
        environment["TMPDIR"] = self.folder.name
        # Threads of the linear algebra would not be in a fork.
        environment["OPENBLAS_NUM_THREADS"] = "1"
        descriptor = theirs.fileno()
        nowhere = subprocess.DEVNULL
        with theirs:
            self.process = subprocess.Popen(
                module_command(__name__, module, str(descriptor), str(mapped)),
                stdin=nowhere,
                stdout=nowhere,
                stderr=nowhere,
                pass_fds=[descriptor],
                env=environment,
                # Ctrl-C of a terminal is for the process that asks.
                start_new_session=True,
            )

    def __exit__(self, *_: object) -> None:
        self.end()

    def ask(
        self,
        request: dict,
        limits: TimeLimits,
        *,
        in_fork: bool = False,
        most: int = MOST,
        progress: Callable[[int], object] = bool,
    ) -> bytes:
        """Return what the process answers.

        Args:
            request: What JSON can hold.
            limits: Of the answer.
            in_fork: Whether it is made in a fork, so that the process outlasts what happens there.
            most: Bytes of an answer.
            progress: Is called with each number of what is done so far.

        Errors:
            Refused: The request is a mistake of the caller.
            NoAnswer: None came in time, or what came is none.
        """
        message = request | {"limits": limits, "in_fork": in_fork}
        wall_s = limits.wall_s + (FORWARD_S if in_fork else 0.0)
        # Of all messages together: foreign code could make progress for ever.
        deadline = time.monotonic() + wall_s
        try:
            self.line.send(json.dumps(message).encode())
            answer = PROGRESS
            while answer[:1] == PROGRESS:
                if answer[1:]:
                    progress(int(answer[1:]))
                left_s = deadline - time.monotonic()
                answer = self.line.receive(left_s, most, self._has_ended)
        except TimeoutError as error:
            raise NoAnswer(HUNG, describe_wait(wall_s), is_over=True) from error
        except ValueError as error:
            raise NoAnswer(FORGED, "it gave back no answer", is_over=True) from error
        except (EOFError, OSError) as error:
            raise self._describe_end(limits.processor_s) from error
        return read_answer(answer)

    def _has_ended(self) -> bool:
        return self.process.poll() is not None

    def _describe_end(self, processor_s: float) -> NoAnswer:
        """Return the error for a process whose line has ended."""
        try:
            code = self.process.wait(CLOSING_S)
        except subprocess.TimeoutExpired:
            return NoAnswer(CRASHED, "it closed its line", is_over=True)
        ending = describe_exit(code)
        if code == -signal.SIGXCPU:
            return NoAnswer(HUNG, describe_use(processor_s), ending, is_over=True)
        fate = KILLED if code == -signal.SIGKILL else CRASHED
        return NoAnswer(fate, f"it ended its process, {ending}", ending, is_over=True)

    def end(self) -> None:
        """Stop the process, wherever it is, and all that it has started."""
        self.line.close()
        if self.process.returncode is None:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        end_all(self.token)
        self.folder.cleanup()


def describe_exit(code: int) -> str:
    """Return how a process ended, in a word or two."""
    return f"exit code {code}" if code >= 0 else signal.Signals(-code).name


def describe_wait(wall_s: float) -> str:
    """Return the reason of a limit on the wall."""
    return f"it did not return within {wall_s:.3g} s"


def describe_use(processor_s: float) -> str:
    """Return the reason of a limit of processor time."""
    return f"it did not return within {processor_s:.3g} s of processor time"


def read_answer(answer: bytes) -> bytes:
    """Return what was asked for; Refused or NoAnswer if the answer is why it did not come."""
    sign, content = answer[:1], answer[1:]
    if sign == DONE:
        return content
    text = content.decode(errors="replace")
    if sign == REFUSED:
        raise Refused(text)
    for fate, known in SIGNS.items():
        if sign == known:
            raise NoAnswer(fate, text[:SHOWN])
    raise NoAnswer(FORGED, "it gave back no answer", is_over=True)


def write_answer(make: Callable[[], bytes]) -> bytes:
    """Return what `make` returns, or why it did not, as an answer."""
    try:
        return DONE + make()
    except BenchError as error:
        return REFUSED + str(error).encode(errors="replace")
    except NoAnswer as error:
        return SIGNS.get(error.fate, SIGNS[CRASHED]) + str(error).encode(errors="replace")
    except Exception as error:
        return SIGNS[CRASHED] + f"{type(error).__name__}: {error}".encode(errors="replace")


def end_all(token: str) -> None:
    """Kill every process but this one that carries the token, until none is left."""
    while carriers := _list_carriers(f"{LAW_PROCESS}={token}".encode()):
        for pid in carriers:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)


def _list_carriers(entry: bytes) -> list[int]:
    """Return the other processes with the entry in their environment; ended ones show none."""
    carriers = []
    for environment in PROCESSES.glob("[0-9]*/environ"):
        pid = int(environment.parent.name)
        with contextlib.suppress(OSError):
            if pid != os.getpid() and entry in environment.read_bytes().split(b"\0"):
                carriers.append(pid)
    return carriers


def confine(mapped: int = MAPPED) -> None:
    """Limit the memory and the files of this process, and of all that it forks."""
    import resource  # the audit's pytest plugin imports us on systems without it, too

    resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_FSIZE, (FILE, FILE))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    if mapped != UNLIMITED:
        resource.setrlimit(resource.RLIMIT_AS, (mapped, mapped))


def guard(module: str, descriptor: int, mapped: int) -> NoReturn:
    """Run the module in a fork, confined; end as it ends, or with the process that asks."""
    child = os.fork()
    if not child:
        confine(mapped)
        sys.argv = [module, str(descriptor)]
        runpy.run_module(module, run_name="__main__", alter_sys=True)
        sys.exit()
    has_hung_up = threading.Event()
    watch = threading.Thread(target=_watch, args=(descriptor, has_hung_up), daemon=True)
    watch.start()
    _, status = os.waitpid(child, 0)
    code = os.waitstatus_to_exitcode(status)
    if has_hung_up.is_set():
        # The watch has ended the child. It removes the folder, and ends this process.
        watch.join()
    if code < 0:
        os.kill(os.getpid(), -code)
    os._exit(abs(code))


def _watch(descriptor: int, has_hung_up: threading.Event) -> NoReturn:
    """Wait until the line hangs up; then end all that carries the token, and this process."""
    folder = Path(os.environ.get("TMPDIR", ""))
    poll = select.poll()
    # A line that hangs up is reported, whatever one waits for.
    poll.register(descriptor, 0)
    poll.poll()
    has_hung_up.set()
    end_all(os.environ.get(LAW_PROCESS, ""))
    if folder.name.startswith(FOLDER):
        shutil.rmtree(folder, ignore_errors=True)
    os._exit(1)


if __name__ == "__main__":
    guard(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]))
