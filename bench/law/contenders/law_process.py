"""A process of its own for a user's law: started, limited, and ended with all that it started.

Nothing of the file runs in the process that asks. What a law prints goes nowhere, its memory has a limit, its temporary
files go with it, and whatever it forks is found again by a token in its environment, if the system shows it (Linux).
Between the two runs a guard, which is the parent that a law sees. It is this module, started with MODULE DESCRIPTOR: it
runs MODULE in a fork, ends as that does, and ends it when the line of this descriptor hangs up.
"""

import contextlib
import json
import os
import resource
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
from collections.abc import Callable, Iterator
from math import ceil
from multiprocessing.connection import Connection
from pathlib import Path
from typing import NoReturn

from bench.base.errors import BadLaw, BenchError
from bench.base.processes import LAW_PROCESS, law_environment, module_command
from bench.law.contenders.law_file import keep_text

TOKEN, FOLDER = LAW_PROCESS, "orientation-bench-law-"
PROCESSES = Path("/proc")
MEMORY, MAPPED, FILE = 4 << 30, 8 << 30, 1 << 28
"""Bytes of data that a law's process may have: compiling all engines takes 1.6e9, most of which is never touched; of
all that it maps, shared memory too; and of a file that it writes, in shared memory too."""

LOOK_S = 0.2
"""How often it is asked whether a silent process is there still."""

HALTS_S, MOST = 60, 1 << 28
"""Seconds on the wall that a message may halt midway, and its bytes: a law may write to the line itself."""


class LawProcess:
    """One process that runs a module of ours, and the line to it. halts_s: see HALTS_S."""

    def __init__(self, module: str, halts_s: float = HALTS_S):
        ours, theirs = socket.socketpair()
        ours.setsockopt(socket.SOL_SOCKET, socket.SO_RCVTIMEO, struct.pack("@ll", ceil(halts_s), 0))
        self.token = secrets.token_hex(8)
        # no threads of the linear algebra, which would not be in a fork; and a terminal's Ctrl-C is the run's to answer
        self.folder = tempfile.TemporaryDirectory(prefix=FOLDER, ignore_cleanup_errors=True)
        environment = law_environment(self.token) | {"OPENBLAS_NUM_THREADS": "1", "TMPDIR": self.folder.name}
        nowhere = subprocess.DEVNULL
        with theirs:
            self.process = subprocess.Popen(
                module_command(__name__, module, str(theirs.fileno())),
                stdin=nowhere,
                stdout=nowhere,
                stderr=nowhere,
                pass_fds=[theirs.fileno()],
                env=environment,
                start_new_session=True,
            )
        self.line = Connection(ours.detach())

    def hear(self, longest_s: float, most: int = MOST) -> bytes:
        """Return what it says next; TimeoutError: nothing for so long, or halted. EOFError, OSError: it has ended."""
        deadline = time.monotonic() + longest_s
        while not self.line.poll(max(0.0, min(LOOK_S, deadline - time.monotonic()))):
            if self.process.poll() is not None and not self.line.poll(0.0):
                raise EOFError  # what it forked may hold the line still
            if time.monotonic() > deadline:
                raise TimeoutError
        try:
            return self.line.recv_bytes(most)
        except BlockingIOError as error:
            raise TimeoutError from error

    def code(self, longest_s: float) -> int | None:
        """Return the exit code of a process whose line has ended; None if it goes on all the same."""
        with contextlib.suppress(subprocess.TimeoutExpired):
            return self.process.wait(longest_s)
        return None

    def end(self) -> int:
        """Stop the process and all that it started; return its exit code if it had already ended."""
        self.line.close()
        if self.process.returncode is None:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self.process.pid, signal.SIGKILL)  # of one that is on its way out, the exit code stays
        code = self.process.wait()
        end_all(self.token)
        self.folder.cleanup()
        return code


def ask(module: str, asked: dict, silent_s: float, files: str) -> Iterator[dict]:
    """Yield what a process of a module of ours says, each an object of JSON, until it is no longer asked.

    asked: the first message. silent_s: on the wall, from one answer to the next. files: the laws', for errors.

    Errors:
        BadLaw: a mistake that the process names, or it did not return, ended, or did not answer in JSON.
    """
    process = LawProcess(module)
    try:
        process.line.send_bytes(json.dumps(asked).encode())
        while True:
            said = dict(json.loads(process.hear(silent_s)))
            if "mistake" in said:
                raise BadLaw(str(said["mistake"]))
            yield said
    except TimeoutError as error:
        raise BadLaw(f"--law {files}: it did not return within {silent_s:g} s; correct the file") from error
    except (EOFError, OSError) as error:
        code = process.end()
        raise BadLaw(f"--law {files}: it ended its process ({ending(code)}); correct the file") from error
    except (ValueError, TypeError, RecursionError) as error:
        raise BadLaw(f"--law {files}: its process did not give back an answer; correct what runs on import") from error
    finally:
        process.end()


def answer(descriptor: int, processor_s: float, make: Callable[[dict, Path | None], dict]) -> None:
    """In a law's own process, say what is made of a message, or the caller's mistake, which names the user's own file.

    make: of the message and the file that holds the law's text, if there is one.
    """
    with Connection(descriptor) as line:
        asked = json.loads(line.recv_bytes())
        path = keep_text(asked["text"]) if asked["text"] else None
        try:
            limit(processor_s)
            said = make(asked, path)
        except BenchError as error:
            said = {"mistake": str(error).replace(str(path), asked["origin"])}
        line.send_bytes(json.dumps(said).encode())


def end_all(token: str) -> None:
    """Kill every process but this one that carries the token, until none is left."""
    while left := [pid for pid in _carriers(f"{TOKEN}={token}".encode()) if pid != os.getpid()]:
        for pid in left:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)


def _carriers(entry: bytes) -> list[int]:
    """Return the processes that have the entry in their environment; those that have ended show none."""
    found = []
    for one in PROCESSES.glob("[0-9]*/environ"):
        with contextlib.suppress(OSError):
            if entry in one.read_bytes().split(b"\0"):
                found.append(int(one.parent.name))
    return found


def limit(processor_s: float, is_last: bool = False) -> None:
    """End this process with SIGXCPU when it has used so many seconds more, rounded up.

    is_last: no other limit follows, so that SIGKILL comes a second later, which nothing ignores.
    """
    used = resource.getrusage(resource.RUSAGE_SELF)
    _, most = resource.getrlimit(resource.RLIMIT_CPU)
    ends = ceil(used.ru_utime + used.ru_stime + processor_s)
    resource.setrlimit(resource.RLIMIT_CPU, (ends, ends + 1 if is_last else most))


def confine() -> None:
    """Limit the memory and the files of this process, and of all that it forks."""
    most = {resource.RLIMIT_DATA: MEMORY, resource.RLIMIT_AS: MAPPED, resource.RLIMIT_FSIZE: FILE}
    for what, amount in (most | {resource.RLIMIT_CORE: 0}).items():
        resource.setrlimit(what, (amount, amount))


def guard(module: str, descriptor: int) -> NoReturn:
    """Run the module in a fork, its memory limited, and end as it ends, or with the run and all that was started."""
    if not (child := os.fork()):
        confine()
        sys.argv = [module, str(descriptor)]
        runpy.run_module(module, run_name="__main__", alter_sys=True)
        sys.exit()
    has_hung_up = threading.Event()
    watch = threading.Thread(target=_watch, args=(descriptor, has_hung_up), daemon=True)
    watch.start()
    code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if has_hung_up.is_set():  # the watch has ended the child; it removes the folder, and ends this process
        watch.join()
    if code < 0:
        os.kill(os.getpid(), -code)
    os._exit(abs(code))


def _watch(descriptor: int, has_hung_up: threading.Event) -> NoReturn:
    folder, poll = Path(os.environ.get("TMPDIR", "")), select.poll()
    poll.register(descriptor, 0)  # a line that hangs up is always reported
    poll.poll()
    has_hung_up.set()
    end_all(os.environ.get(TOKEN, ""))
    if folder.name.startswith(FOLDER):
        shutil.rmtree(folder, ignore_errors=True)
    os._exit(1)


def ending(code: int) -> str:
    """How a process ended, in a word or two."""
    return f"exit code {code}" if code >= 0 else signal.Signals(-code).name


if __name__ == "__main__":
    guard(sys.argv[1], int(sys.argv[2]))
