"""The processes of users' laws that are kept for the next request, and whose turn it is to have one at work."""

import contextlib
import threading
from collections.abc import Callable, Iterator

from bench.running.sandbox_line import Process

TURNS = 256
"""Threads that may have a process at work at once."""


class Pool:
    """Processes, each at work for one thread or idle.

    most: that are kept before an idle one of another law is ended. turns: a thread holds one while it is at work.
    """

    def __init__(self, most: int):
        self.most = most
        self._idle: list[Process] = []
        self._all: list[Process] = []
        self._taking, self._one_alone = threading.Lock(), threading.Lock()
        self.turns = threading.Semaphore(TURNS)

    def take(self, law: str, begin: Callable[[], Process]) -> Process:
        """Return an idle process of the law, or a new one."""
        with self._taking:
            found = next((one for one in reversed(self._idle) if one.law == law), None)
            if found is None and len(self._all) >= self.most and self._idle:
                self._end(self._idle.pop())  # the oldest comes first when all are gone through again
            if found is None:
                found = begin()
                self._all.append(found)
            else:
                self._idle.remove(found)
            return found

    def give_back(self, process: Process, has_ended: bool) -> None:
        """Keep a process for the next request, or end it."""
        with self._taking:
            if has_ended:
                self._end(process)
            else:
                self._idle.append(process)

    def end_all(self) -> None:
        """End every process, those at work too."""
        for process in self._all:
            process.end()

    def _end(self, process: Process) -> None:
        process.end()
        self._all.remove(process)

    @contextlib.contextmanager
    def alone(self) -> Iterator[None]:
        """For a thread that has a turn: wait until it is the only one, and end the processes that are idle."""
        self.turns.release()
        with self._one_alone:
            for _ in range(TURNS):
                self.turns.acquire()
            with self._taking:
                while self._idle:
                    self._end(self._idle.pop())
            try:
                yield
            finally:
                self.turns.release(TURNS - 1)
