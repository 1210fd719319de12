"""A user's laws kept apart (sandbox_process.py), so that one that hangs or dies costs its own rows and never the run.

Every request has a limit. A unit that was lost is run again one episode after the other, and only those that do not
come back are rows with the outcome `hung` or `crashed`; after MOST_LOST of them the rest of the unit counts as lost
without being tried, and so does a whole unit of which no part can be asked for.
"""

import contextlib
import functools
import json
import os
import queue
import socket
import subprocess
import sys
from collections.abc import Iterator
from multiprocessing.connection import Connection

import pyarrow as pa

from bench.errors import BadLaw
from bench.experiments.experiment import Unit, experiment_of
from bench.experiments.plan import Plan
from bench.running import sandbox_process
from bench.running.wire_format import described
from bench.tables.store import as_table, joined
from tasks.verdict import CRASHED, HUNG, OUTCOMES

PATIENCE_S, SINGLE_S = 30.0, 1.0
"""A unit's limit, and that of an episode by itself, beside TICK_S for each of their ticks."""

TICK_S = {"": 1e-5, "ideal-rk4": 1e-5, "ideal-held": 1e-5, "native": 1e-4, "reference": 2e-3}
"""Seconds of processor time, by engine: ten times what a tick of ours takes. A perturbed body is simulated as
ideal-held is."""

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
        self._own = {one.name: one for one in plan.settings.own}
        self._tried: dict[Unit, pa.Table] = {}
        self._idle: queue.LifoQueue[_Process] = queue.LifoQueue()
        self._all: list[_Process] = []

    def __enter__(self) -> "Guard":
        return self

    def __exit__(self, *_) -> None:
        for process in self._all:
            process.end()

    def has(self, unit: Unit) -> bool:
        """Whether the unit is of a user's law."""
        return _law_of(unit) in self._own

    def check(self) -> None:
        """Compile the laws for every engine that they run on, and try them where an experiment says so.

        Errors:
            BadLaw: one that cannot be compiled or counted.
        """
        own = [unit for unit in self.plan.units if self.has(unit)]
        firsts = {(unit.experiment, unit.contender, unit.engine): unit for unit in reversed(own)}
        for unit in reversed(firsts.values()):
            try:
                with self._process(unit) as process:
                    process.prepare(unit)
            except Lost as lost:
                raise BadLaw(
                    f"--law {self._own[_law_of(unit)].origin}: it cannot be compiled for "
                    f"{unit.engine or unit.experiment} ({lost}); mend the file"
                ) from lost
        for unit in own:
            if experiment_of(unit).is_tried_first and not unit.arm:
                self._tried[unit] = self.rows(unit)

    def rows(self, unit: Unit) -> pa.Table:
        """The rows of a unit, whatever becomes of its law.

        Errors:
            BadLaw: a law beyond the dialect. KeyboardInterrupt: the run stops before all episodes were tried.
        """
        if unit in self._tried:
            return self._tried.pop(unit)
        experiment = experiment_of(unit)
        try:
            return self._rows(unit, unit, PATIENCE_S)
        except Lost as lost:
            if not experiment.is_divisible:
                made = self._lost(unit, lost.outcome)
                what = f"its {unit.episodes} episodes are {lost.outcome}"
                self._note(f"{unit.label}: {lost}; {what if made.num_rows else 'it has no rows'}")
                return made
            self._note(f"{unit.label}, {unit.selector} from {unit.first}: {lost}; its episodes are run singly")
        return joined(list(self._one_by_one(unit)))

    def _one_by_one(self, unit: Unit) -> Iterator[pa.Table]:
        lost_before, end = 0, unit.first + unit.count
        for first in range(unit.first, end):
            if self.stopping:
                raise KeyboardInterrupt
            single = unit.part(first, 1)
            try:
                yield self._rows(unit, single, SINGLE_S)
            except Lost as lost:
                lost_before += 1
                gives_up = lost_before == MOST_LOST
                yield self._lost(unit.part(first, end - first) if gives_up else single, lost.outcome)
                if gives_up:
                    return

    def _lost(self, unit: Unit, outcome: str) -> pa.Table:
        experiment = experiment_of(unit)
        return as_table(experiment.lost(self.plan.settings, unit, outcome), experiment.table)

    def _rows(self, unit: Unit, some: Unit, patience_s: float) -> pa.Table:
        """The rows of some of a unit's episodes."""
        limit_s = patience_s + TICK_S[unit.engine] * experiment_of(unit).ticks(self.plan.settings, some)
        if self.limit_s is not None:
            limit_s = self.limit_s if some is unit else min(self.limit_s, limit_s)
        with self._process(unit) as process:
            process.prepare(unit)
            return sandbox_process.unpacked(process.ask(unit, some, limit_s))

    def _note(self, text: str) -> None:
        text = "".join(sign if sign.isprintable() else " " for sign in text)  # it may hold what a law raised
        self.notes.append(text)
        print(text, file=sys.stderr)

    @contextlib.contextmanager
    def _process(self, unit: Unit) -> Iterator["_Process"]:
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
            raise BadLaw(f"--law {self._own[_law_of(unit)].origin}: {reason}") from mistake
        else:
            self._idle.put(process)

    @functools.cached_property
    def _chunk(self) -> bytes:
        return json.dumps(described(self.plan, [unit for unit in self.plan.units if self.has(unit)])).encode()


def _law_of(unit: Unit) -> str:
    """The name of the law."""
    return unit.contender.partition("@")[0].partition("/")[0]


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

    def prepare(self, unit: Unit) -> None:
        """Compile, import and build what the unit needs."""
        place = (unit.experiment, unit.contender, unit.engine, unit.selector, unit.arm)
        if place not in self.prepared:
            self._say(json.dumps({"key": unit.key}).encode(), START_S)
            self.prepared.add(place)

    def ask(self, unit: Unit, some: Unit, limit_s: float) -> bytes:
        """The rows of a unit, or of some of its starts.

        Errors:
            Lost: they did not come in time, or the process ended, or the law broke the judge. Mistake: the user's.
        """
        longest_s = AND_S + WAITING * limit_s
        asked = {"key": unit.key, "processor_s": limit_s, "longest_s": longest_s}
        if some is not unit:
            asked |= {"first": some.first, "count": some.count}
        return self._say(json.dumps(asked).encode(), longest_s + START_S)

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
