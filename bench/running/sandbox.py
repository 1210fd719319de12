"""A user's laws kept apart (sandbox_process.py), so that one that hangs or dies costs its own rows and never the run.

Every request has a limit. A unit that was lost is run again one episode after the other, and only those that do not
come back are rows with the outcome `hung` or `crashed`; after MOST_LOST of them the rest of the unit counts as lost
without being tried, and so does a whole unit in trouble, of which no part can be asked for.
"""

import contextlib
import dataclasses
import functools
import json
import os
import queue
import socket
import subprocess
import sys
from collections.abc import Iterator
from multiprocessing.connection import Connection
from typing import TypeGuard

import pyarrow as pa

from bench.errors import BadLaw
from bench.experiments.boundary import SCAN
from bench.experiments.plan import AnyUnit, Plan, Unit
from bench.experiments.robustness_plan import RobustnessUnit
from bench.experiments.suites import SHORT
from bench.experiments.work import lost_rows
from bench.running import sandbox_process
from bench.running.wire_format import described
from bench.tables.store import as_table, joined
from tasks.verdict import CRASHED, HUNG, OUTCOMES

PATIENCE_S, SINGLE_S = 30.0, 1.0
"""A unit's limit, and that of an episode by itself, beside TICK_S for each of their ticks."""

TICK_S = {"ideal-rk4": 1e-5, "ideal-held": 1e-5, "native": 1e-4, "reference": 2e-3}
"""Seconds of processor time: ten times what a tick of ours takes."""

SHORTEST_S = 1e-4
"""Control period in trouble, at the highest rate."""

TABLE_S = 100.0
"""For counting a law, and for its curves: each is done in seconds."""

WAITING, AND_S = 10.0, 20.0
"""Times the limit, and seconds more, on the wall: for a law that waits, or is kept waiting by a busy machine."""

START_S = 1800.0
"""On the wall: for the process to start, and to compile, which has a limit of its own."""

MOST_LOST = 100
"""Episodes of a unit that may be lost one by one, each for SINGLE_S."""

SIGNS = {sandbox_process.CRASHED: OUTCOMES[CRASHED], sandbox_process.HUNG: OUTCOMES[HUNG]}


class Lost(Exception):
    """What was asked for did not come: the outcome, as a word, and the reason."""

    def __init__(self, outcome: str, reason: str):
        self.outcome = outcome
        super().__init__(reason)


class Guard:
    """The processes of a plan's own laws, as many as there are threads that ask; started when first needed.

    Args:
        limit_s: of processor time for every request, compiling apart; None for the rule above.
    """

    def __init__(self, plan: Plan, limit_s: float | None = None):
        self.plan, self.limit_s = plan, limit_s
        self.stopping = False
        self.notes: list[str] = []
        self._counted: list[dict] = []
        self._own = {one.name: one for one in plan.contenders if one.regulator.origin}
        self._idle: queue.LifoQueue[_Process] = queue.LifoQueue()
        self._all: list[_Process] = []

    def __enter__(self) -> "Guard":
        return self

    def __exit__(self, *_) -> None:
        for process in self._all:
            process.end()

    def has(self, unit: AnyUnit) -> TypeGuard[Unit | RobustnessUnit]:
        """Whether the unit is of a user's law."""
        return unit.contender in self._own

    def check(self) -> None:
        """Compile the laws for every engine that they run on, and count their operations.

        Errors:
            BadLaw: one that cannot be compiled or counted.
        """
        firsts = {(unit.contender, _engine(unit)): unit for unit in reversed(self.plan.work) if self.has(unit)}
        for unit in reversed(firsts.values()):
            try:
                with self._process(unit.contender) as process:
                    process.prepare(unit)
            except Lost as lost:
                raise BadLaw(
                    f"--law {self._own[unit.contender].regulator.origin}: it cannot be compiled for {_engine(unit)} "
                    f"({lost}); mend the file"
                ) from lost
        self._counted = self._costs(on_arms=False)

    def rows(self, unit: Unit | RobustnessUnit) -> pa.Table:
        """The rows of a unit, whatever becomes of its law.

        Errors:
            KeyboardInterrupt: the run stops before all episodes were tried.
        """
        try:
            return self._rows(unit, unit, PATIENCE_S)
        except Lost as lost:
            if not isinstance(unit, Unit):
                self._note(f"{unit.label}: {lost}; its {unit.count} episodes are {lost.outcome}")
                return as_table(lost_rows(self.plan, unit, lost.outcome), unit.table)
            self._note(f"{unit.label}, {unit.start_set} from {unit.first}: {lost}; its episodes are run singly")
        return joined(list(self._one_by_one(unit)))

    def _one_by_one(self, unit: Unit) -> Iterator[pa.Table]:
        lost_before, end = 0, unit.first + unit.count
        for first in range(unit.first, end):
            if self.stopping:
                raise KeyboardInterrupt
            single = dataclasses.replace(unit, first=first, count=1)
            try:
                yield self._rows(unit, single, SINGLE_S)
            except Lost as lost:
                lost_before += 1
                gives_up = lost_before == MOST_LOST
                some = dataclasses.replace(unit, first=first, count=end - first) if gives_up else single
                yield as_table(lost_rows(self.plan, some, lost.outcome), unit.table)
                if gives_up:
                    return

    def _rows(self, unit: AnyUnit, some: AnyUnit, patience_s: float) -> pa.Table:
        """The rows of some of a unit's episodes."""
        limit_s = patience_s + TICK_S[_engine(some)] * _ticks(self.plan, some)
        if self.limit_s is not None:
            limit_s = self.limit_s if some is unit else min(self.limit_s, limit_s)
        asked: dict = {"what": "rows", "key": unit.key}
        if isinstance(some, Unit):
            asked |= {"first": some.first, "count": some.count}
        with self._process(unit.contender) as process:
            process.prepare(unit)
            return sandbox_process.unpacked(process.ask(asked, limit_s))

    def costs(self) -> list[dict]:
        """Operations of the laws, and of their controllers on arms; what was lost has none.

        Errors:
            BadLaw: a controller beyond the dialect.
        """
        return self._counted + self._costs(on_arms=True)

    def _costs(self, on_arms: bool) -> list[dict]:
        """Those of a law beyond the dialect are an error, unless only the reference engine runs it."""
        made: list[dict] = []
        only_reference = all(unit.engine == "reference" for unit in self.plan.units)
        for one in self._own.values():
            if one.is_on_arm == on_arms:
                try:
                    made += json.loads(self._table("costs", one.name, TABLE_S) or b"[]")
                except BadLaw:
                    if not only_reference:
                        raise
        return made

    def tables(self, what: str) -> list[pa.Table]:
        """Traces or boundaries, one table for each law that came back."""
        if not (self.plan.boundary_axes if what == "boundaries" else self.plan.traces or self.plan.arm_traces):
            return []
        limit_s = TABLE_S + TICK_S["ideal-rk4"] * self.plan.boundary_axes * len(SCAN) * SHORT / self.plan.dt_s
        made = (self._table(what, name, limit_s) for name in self._own)
        return [sandbox_process.unpacked(content) for content in made if content]

    def _table(self, what: str, contender: str, limit_s: float) -> bytes:
        """What is made of a law as a whole; nothing if it was lost."""
        try:
            with self._process(contender) as process:
                return process.ask({"what": what, "contender": contender}, self.limit_s or limit_s)
        except Lost as lost:
            self._note(f"{contender}: {lost}; {what}.parquet has no rows of it")
            return b""

    def _note(self, text: str) -> None:
        text = "".join(sign if sign.isprintable() else " " for sign in text)  # it may hold what a law raised
        self.notes.append(text)
        print(text, file=sys.stderr)

    @contextlib.contextmanager
    def _process(self, contender: str) -> Iterator["_Process"]:
        """One that is idle, or a new one; it is idle again unless it was lost."""
        try:
            process = self._idle.get_nowait()
        except queue.Empty:
            process = _Process(self._chunk)
            self._all.append(process)
        try:
            yield process
        except _Ended:
            process.end()
            self._all.remove(process)
            raise
        except Lost:
            self._idle.put(process)
            raise
        except Mistake as mistake:
            self._idle.put(process)
            # the process has the law in a file of another name
            reason = str(mistake).partition(": ")[2]
            raise BadLaw(f"--law {self._own[contender].regulator.origin}: {reason}") from mistake
        else:
            self._idle.put(process)

    @functools.cached_property
    def _chunk(self) -> bytes:
        return json.dumps(described(self.plan, [unit for unit in self.plan.work if self.has(unit)])).encode()


def _engine(unit: AnyUnit) -> str:
    """The engine of a unit; in trouble it is the ideal plant's."""
    return unit.engine if isinstance(unit, Unit) else "ideal-held"


def _ticks(plan: Plan, unit: AnyUnit) -> float:
    """Control periods that a unit takes at most."""
    return unit.count * unit.horizon_s / (plan.dt_s if isinstance(unit, Unit) else SHORTEST_S)


class _Ended(Lost):
    """The process itself is gone, or must go."""


class Mistake(Exception):
    """The user's mistake, in the words of the other process."""


class _Process:
    """One process, and the line to it."""

    def __init__(self, chunk: bytes):
        ours, theirs = socket.socketpair()
        words = [sys.executable, "-m", sandbox_process.__name__, str(theirs.fileno())]
        # no threads of the linear algebra, which would not be in a fork; and a terminal's Ctrl-C is the run's to answer
        environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
        with theirs:
            self.process = subprocess.Popen(
                words,
                stdin=subprocess.DEVNULL,
                pass_fds=[theirs.fileno()],
                env=environment,
                start_new_session=True,
            )
        self.line = Connection(ours.detach())
        self.prepared: set = set()
        self._say(chunk, START_S)

    def prepare(self, unit: AnyUnit) -> None:
        """Compile, import and build what the unit needs."""
        place = (unit.contender, _engine(unit), getattr(unit, "start_set", ""), getattr(unit, "arm", ""))
        if place not in self.prepared:
            self._say(json.dumps({"what": "ready", "key": unit.key}).encode(), START_S)
            self.prepared.add(place)

    def ask(self, asked: dict, limit_s: float) -> bytes:
        """The answer to a request.

        Errors:
            Lost: it did not come in time, or the process ended, or the law broke the judge. Mistake: the user's.
        """
        longest_s = AND_S + WAITING * limit_s
        said = {**asked, "processor_s": limit_s, "longest_s": longest_s}
        return self._say(json.dumps(said).encode(), longest_s + START_S)

    def _say(self, said: bytes, longest_s: float) -> bytes:
        try:
            self.line.send_bytes(said)
            if not self.line.poll(longest_s):
                raise _Ended(OUTCOMES[HUNG], f"it did not return within {longest_s:g} s")
            content = self.line.recv_bytes()
        except (EOFError, OSError) as error:
            raise _Ended(OUTCOMES[CRASHED], "its process was ended") from error
        sign, rest = content[:1], content[1:]
        if sign == sandbox_process.MISTAKE:
            raise Mistake(rest.decode())
        if sign in SIGNS:
            raise Lost(SIGNS[sign], rest.decode())
        return rest

    def end(self) -> None:
        """Stop it, wherever it is."""
        self.line.close()
        self.process.kill()
        self.process.wait()
