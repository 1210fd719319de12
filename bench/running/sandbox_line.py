"""Processes of users' laws (sandbox_process.py): requests, limits, how one ends, and which are kept for the next."""

import contextlib
import json
import signal
import threading
from collections.abc import Callable, Iterator

import pyarrow as pa

from bench.base.errors import BadResults
from bench.experiments.experiment import Unit, experiment_of
from bench.experiments.request import Request
from bench.experiments.tables.packed import most_bytes, unpack
from bench.law.contenders.law_process import LawProcess
from bench.running import sandbox_process
from bench.running.answers import check_rows, most_rows
from tasks.verdict import CRASHED, HUNG, OUTCOMES

WAITING, AND_S = 10.0, 20.0
"""Times the limit, and seconds more, on the wall: for a law that waits, or is kept waiting by a busy machine."""

START_S = 600.0
"""On the wall: for the process to start, and to compile, which has a limit of its own."""

CLOSING_S = 5.0
"""On the wall, from the end of the line to that of the process."""

TURNS, MOST_KEPT = 256, 8
"""Threads that may have a process at work at once; and processes that are kept, compiled code and all, until another
law needs one: each takes 0.2 GB."""

SHORT, SHOWN = 1 << 16, 400
"""Bytes of an answer that is no rows; and signs of a reason that are shown."""

SIGNS = {sandbox_process.CRASHED: OUTCOMES[CRASHED], sandbox_process.HUNG: OUTCOMES[HUNG]}


class Lost(Exception):
    """What was asked for did not come: the outcome, as a word, and the reason."""

    def __init__(self, outcome: str, reason: str):
        self.outcome = outcome
        super().__init__(reason)


class Ended(Lost):
    """The process itself is gone, or must go."""


class Killed(Ended):
    """Something killed the process while it prepared: the system when memory is short, a person, or the law itself."""


class Forged(Lost):
    """The answer holds no rows, or other rows than the unit has."""


class Mistake(Exception):
    """The user's mistake, in the words of the other process."""


class Process:
    """One process, and the line to it. settings: its request. chunk: the first message, about one law, if not sent."""

    def __init__(self, law: str, settings: Request, chunk: bytes):
        self.law, self.settings, self.chunk = law, settings, chunk
        self.process = LawProcess(sandbox_process.__name__)
        self.prepared: set = set()

    def prepare(self, unit: Unit) -> None:
        """Load the law; compile, import and build what the unit needs.

        Lost: the law did not let it. Killed: something else may not have. Mistake: the user's.
        """
        place = (unit.experiment, unit.contender, unit.engine, unit.selector, unit.arm)
        try:
            if self.chunk:
                self._say(self.chunk, START_S)
                self.chunk = b""
            if place not in self.prepared:
                self._say(json.dumps({"key": unit.key}).encode(), START_S)
                self.prepared.add(place)
        except Ended as ended:
            if self.process.code(CLOSING_S) == -signal.SIGKILL:
                raise Killed(ended.outcome, "its process was killed while it prepared (SIGKILL)") from ended
            raise

    def ask(self, unit: Unit, some: Unit, limit_s: float) -> pa.Table:
        """Return the rows of a unit, or of some of its starts; Lost if none came in time, Forged if they are others."""
        longest_s = AND_S + WAITING * limit_s
        asked = {"key": unit.key, "processor_s": limit_s, "longest_s": longest_s}
        if some is not unit:
            asked |= {"first": some.first, "count": some.count}
        table, most = experiment_of(unit).table, most_rows(some)
        content = self._say(json.dumps(asked).encode(), longest_s + START_S, most_bytes(table, most))
        try:
            made = unpack(content, table, most)
            check_rows(self.settings, some, made.to_pandas())
            return made
        except (BadResults, ValueError) as error:
            raise Forged(OUTCOMES[CRASHED], f"what it gave back is not its rows: {str(error)[:SHOWN]}") from error

    def _say(self, said: bytes, longest_s: float, most: int = SHORT) -> bytes:
        try:
            self.process.line.send_bytes(said)
            content = self.process.hear(longest_s, most)
        except TimeoutError as error:
            raise Ended(OUTCOMES[HUNG], f"it did not return within {longest_s:g} s") from error
        except (EOFError, OSError) as error:
            raise Ended(OUTCOMES[CRASHED], "its process was ended") from error
        sign, rest = content[:1], content[1:]
        if sign == sandbox_process.MISTAKE:
            raise Mistake(rest.decode(errors="replace"))
        if sign in SIGNS:
            raise (Ended if self.chunk else Lost)(SIGNS[sign], rest[:SHOWN].decode(errors="replace"))
        if sign != sandbox_process.DONE:
            raise Ended(OUTCOMES[CRASHED], "its process gave back no answer")
        return rest

    def end(self) -> None:
        """Stop it, wherever it is, and all that the law has started."""
        self.process.end()


class Pool:
    """Processes, each at work for one thread or idle. turns: a thread holds one while it is at work."""

    def __init__(self) -> None:
        self._idle: list[Process] = []
        self._all: list[Process] = []
        self._taking, self._one_alone = threading.Lock(), threading.Lock()
        self.turns = threading.Semaphore(TURNS)

    def take(self, law: str, begin: Callable[[str], Process]) -> Process:
        """Return an idle process of the law, or a new one."""
        with self._taking:
            found = next((one for one in reversed(self._idle) if one.law == law), None)
            if found is None and len(self._all) >= MOST_KEPT and self._idle:
                self._end(self._idle.pop())  # the oldest comes first when all are gone through again
            if found is None:
                found = begin(law)
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
