"""A process of its own for a user's law: started, limited, and ended with all that it started.

Nothing of the file runs in the process that asks. What a law prints goes nowhere, its memory has a limit, its temporary
files go with it, and whatever it forks is found again by a token in its environment, if the system shows it (Linux).
"""

import contextlib
import os
import resource
import secrets
import select
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
from math import ceil
from multiprocessing.connection import Connection
from pathlib import Path
from typing import NoReturn

TOKEN, FOLDER = "ORIENTATION_BENCH_LAW_PROCESS", "orientation-bench-law-"
PROCESSES = Path("/proc")
MEMORY = 4 << 30
"""Bytes of data that a law's process may have: compiling all engines takes 1.6e9, most of which is never touched."""

LOOK_S = 0.2
"""How often it is asked whether a silent process is there still."""


class LawProcess:
    """One process that runs a module of ours, and the line to it."""

    def __init__(self, module: str):
        ours, theirs = socket.socketpair()
        self.token = secrets.token_hex(8)
        # no threads of the linear algebra, which would not be in a fork; and a terminal's Ctrl-C is the run's to answer
        self.folder = tempfile.TemporaryDirectory(prefix=FOLDER, ignore_cleanup_errors=True)
        environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", TOKEN: self.token, "TMPDIR": self.folder.name}
        nowhere = subprocess.DEVNULL
        with theirs:
            self.process = subprocess.Popen(
                [sys.executable, "-m", module, str(theirs.fileno())],
                stdin=nowhere,
                stdout=nowhere,
                stderr=nowhere,
                pass_fds=[theirs.fileno()],
                env=environment,
                start_new_session=True,
            )
        self.line = Connection(ours.detach())

    def hear(self, longest_s: float) -> bytes:
        """The next thing that it says.

        Errors:
            TimeoutError: it said nothing for so long. EOFError, OSError: it has ended.
        """
        deadline = time.monotonic() + longest_s
        while not self.line.poll(max(0.0, min(LOOK_S, deadline - time.monotonic()))):
            if self.process.poll() is not None and not self.line.poll(0.0):
                raise EOFError  # what it forked may hold the line still
            if time.monotonic() > deadline:
                raise TimeoutError
        return self.line.recv_bytes()

    def end(self) -> int:
        """Stop it, and all that it started; its exit code, if it had ended by itself."""
        self.line.close()
        if self.process.returncode is None:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self.process.pid, signal.SIGKILL)  # of one that is on its way out, the exit code stays
        code = self.process.wait()
        end_all(self.token)
        self.folder.cleanup()
        return code


def end_all(token: str) -> None:
    """Kill every process but this one that carries the token, until none is left."""
    while left := [pid for pid in _carriers(f"{TOKEN}={token}".encode()) if pid != os.getpid()]:
        for pid in left:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)


def _carriers(entry: bytes) -> list[int]:
    """Processes in whose environment the entry stands; those that have ended show none."""
    found = []
    for one in PROCESSES.glob("[0-9]*/environ"):
        with contextlib.suppress(OSError):
            if entry in one.read_bytes().split(b"\0"):
                found.append(int(one.parent.name))
    return found


def confine() -> None:
    """Limit this process's memory."""
    _, most = resource.getrlimit(resource.RLIMIT_DATA)
    resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, most))


def limit(processor_s: float) -> None:
    """End this process with SIGXCPU when it has used so many seconds more, rounded up."""
    used = resource.getrusage(resource.RUSAGE_SELF)
    _, most = resource.getrlimit(resource.RLIMIT_CPU)
    resource.setrlimit(resource.RLIMIT_CPU, (ceil(used.ru_utime + used.ru_stime + processor_s), most))


def end_with(descriptor: int) -> None:
    """From now on, when the other end of this line is gone, this process and all that it started are ended."""
    folder = Path(os.environ.get("TMPDIR", ""))
    threading.Thread(target=_watch, args=(descriptor, folder), daemon=True).start()


def _watch(descriptor: int, folder: Path) -> NoReturn:
    poll = select.poll()
    poll.register(descriptor, 0)  # a line that hangs up is always reported
    poll.poll()
    end_all(os.environ.get(TOKEN, ""))
    if folder.name.startswith(FOLDER):
        shutil.rmtree(folder, ignore_errors=True)
    os._exit(1)


def ending(code: int) -> str:
    """How a process ended, in a word or two."""
    return f"exit code {code}" if code >= 0 else signal.Signals(-code).name
