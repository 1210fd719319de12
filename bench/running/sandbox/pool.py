"""Processes of users' laws (server.py): their requests, and which of them are kept for the next one."""

import contextlib
import threading
from collections.abc import Callable, Iterator

import pyarrow as pa

from bench.base.errors import BadResults
from bench.base.isolated import FORGED, SHOWN, IsolatedProcess, NoAnswer, TimeLimits
from bench.experiments.experiment import Unit, experiment_of
from bench.experiments.request import Request
from bench.experiments.tables.packed import most_bytes, unpack
from bench.running.sandbox import server
from bench.running.sandbox.answers import check_rows, most_rows

WAITING, AND_S = 10.0, 20.0
"""Times the limit of processor time, and seconds more, on the wall: for a law that waits, or is kept
waiting by a busy machine."""

READY = TimeLimits(processor_s=120.0, wall_s=600.0)
"""Limits for a process to load its law, and to compile: twice what all engines take that were never
compiled before."""

TURNS, MOST_KEPT = 256, 8
"""Threads that may have a process at work at once; and processes that are kept, compiled code and
all, until another law needs one: each takes 0.2 GB."""


class LawProcess(IsolatedProcess):
    """A process of a law.

    Attributes:
        law: Its name.
        request: The plan's.
        plan: The units of the law and what they need, until the process has them.
        prepared: Places that the law is compiled for.
    """

    def __init__(self, law: str, request: Request, plan: dict):
        super().__init__(server.__name__)
        self.law = law
        self.request = request
        self.plan: dict | None = plan
        self.prepared: set[tuple[str, ...]] = set()

    def prepare(self, unit: Unit) -> None:
        """Load the law; compile, import and build what the unit needs.

        Errors:
            NoAnswer: The law did not let it; or, KILLED, something else may not have.
            Refused: The law is beyond the dialect.
        """
        if self.plan is not None:
            try:
                self.ask({"plan": self.plan}, READY)
            except NoAnswer as error:
                # A process without the law is of no use.
                error.is_over = True
                raise
            self.plan = None
        place = (unit.experiment, unit.contender, unit.engine, unit.selector, unit.arm)
        if place not in self.prepared:
            self.ask({"key": unit.key}, READY)
            self.prepared.add(place)

    def make_rows(self, unit: Unit, stretch: Unit, limit_s: float) -> pa.Table:
        """Return the rows of a unit, or of a stretch of its starts; limit_s: of processor time.

        Errors:
            NoAnswer: None came in time; or, FORGED, they are others.
        """
        # Another thread may have taken the process that was prepared.
        self.prepare(unit)
        table = experiment_of(unit).table
        most = most_rows(stretch)
        starts = None if stretch is unit else (stretch.first, stretch.count)
        content = self.ask(
            {"key": unit.key, "starts": starts},
            TimeLimits(limit_s, AND_S + WAITING * limit_s),
            in_fork=True,
            most=most_bytes(table, most),
        )
        try:
            rows = unpack(content, table, most)
            check_rows(self.request, stretch, rows.to_pandas())
        except (BadResults, ValueError) as error:
            reason = f"what it gave back is not its rows: {str(error)[:SHOWN]}"
            raise NoAnswer(FORGED, reason) from error
        return rows


class Pool:
    """Processes, each at work for one thread or idle.

    Attributes:
        turns: A thread holds one while it is at work.
    """

    def __init__(self) -> None:
        self._idle: list[LawProcess] = []
        self._all: list[LawProcess] = []
        self._taking = threading.Lock()
        self._being_alone = threading.Lock()
        self.turns = threading.Semaphore(TURNS)

    @contextlib.contextmanager
    def lend(self, law: str, begin: Callable[[str], LawProcess]) -> Iterator[LawProcess]:
        """Yield an idle process of the law, or a new one; it is idle again unless it is over."""
        process = self._take(law, begin)
        is_over = False
        try:
            yield process
        except NoAnswer as error:
            is_over = error.is_over
            raise
        finally:
            with self._taking:
                if is_over:
                    self._end(process)
                else:
                    self._idle.append(process)

    def _take(self, law: str, begin: Callable[[str], LawProcess]) -> LawProcess:
        with self._taking:
            for process in reversed(self._idle):
                if process.law == law:
                    self._idle.remove(process)
                    return process
            if len(self._all) >= MOST_KEPT and self._idle:
                # The oldest comes first when all laws are gone through again.
                self._end(self._idle.pop())
            process = begin(law)
            self._all.append(process)
            return process

    def end_all(self) -> None:
        """End every process, those at work too."""
        for process in self._all:
            process.end()

    def _end(self, process: LawProcess) -> None:
        process.end()
        self._all.remove(process)

    @contextlib.contextmanager
    def alone(self) -> Iterator[None]:
        """For a thread that has a turn: wait until it is the only one, and end what is idle."""
        self.turns.release()
        with self._being_alone:
            for _ in range(TURNS):
                self.turns.acquire()
            with self._taking:
                while self._idle:
                    self._end(self._idle.pop())
            try:
                yield
            finally:
                self.turns.release(TURNS - 1)
