"""A user's laws kept apart (sandbox_process.py), so that one that hangs or dies costs its own rows and never the run.

Every request has a limit. A unit that was lost is run again one episode after the other, and only those that do not
come back are rows with the outcome `hung` or `crashed`; after MOST_LOST of them the rest of the unit counts as lost
without being tried, and so does a whole unit of which no part can be asked for.
"""

import contextlib
import functools
import json
import queue
import sys
from collections.abc import Iterator

import pyarrow as pa

from bench.errors import BadLaw
from bench.experiments.experiment import Unit, experiment_of
from bench.experiments.plan import Plan
from bench.running import sandbox_process
from bench.running.sandbox_line import Ended, Lost, Mistake, Process
from bench.running.wire_format import described
from bench.tables.store import as_table, joined

PATIENCE_S, SINGLE_S = 30.0, 1.0
"""A unit's limit, and that of an episode by itself, beside TICK_S for each of their ticks."""

TICK_S = {"": 1e-5, "ideal-rk4": 1e-5, "ideal-held": 1e-5, "native": 1e-4, "reference": 2e-3}
"""Seconds of processor time, by engine: ten times what a tick of ours takes. A perturbed body is simulated as
ideal-held is."""

MOST_LOST = 100
"""Episodes of a unit that may be lost one by one, each for SINGLE_S."""


class Sandbox:
    """The processes of a plan's own laws, as many as there are threads that ask; started when first needed.

    Args:
        limit_s: of processor time for every request, compiling apart; None for the rule above. most_lost: episodes of a
            unit, see MOST_LOST.
    """

    def __init__(self, plan: Plan, limit_s: float | None = None, most_lost: int = MOST_LOST):
        self.plan, self.limit_s, self.most_lost = plan, limit_s, most_lost
        self.stopping = False
        self.notes: list[str] = []
        self._own = {one.name: one for one in plan.settings.own}
        self._tried: dict[Unit, pa.Table] = {}
        self._unready: dict[tuple[str, str, str], Lost] = {}
        self._idle: queue.LifoQueue[Process] = queue.LifoQueue()
        self._all: list[Process] = []

    def __enter__(self) -> "Sandbox":
        return self

    def __exit__(self, *_) -> None:
        for process in self._all:
            process.end()

    def has(self, unit: Unit) -> bool:
        """Whether the unit is of a user's law."""
        return unit.law in self._own

    def check(self) -> None:
        """Compile the laws for every engine that they run on, and try them where an experiment says so.

        Errors:
            BadLaw: one beyond the dialect.
        """
        own = [unit for unit in self.plan.units if self.has(unit)]
        firsts = {self._place(unit): unit for unit in reversed(own)}
        for unit in reversed(firsts.values()):
            with contextlib.suppress(Lost), self._process(unit):
                pass
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
            if self._place(unit) in self._unready:
                return self._lost(unit, lost.outcome)
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
                gives_up = lost_before == self.most_lost
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
            return sandbox_process.unpacked(process.ask(unit, some, limit_s))

    @staticmethod
    def _place(unit: Unit) -> tuple[str, str, str]:
        """What a law is compiled for."""
        return unit.experiment, unit.contender, unit.engine

    def _prepare(self, process: Process, unit: Unit) -> None:
        """Compile, import and build what the unit needs; where that lost the law once, it is not tried again."""
        place = self._place(unit)
        if place not in self._unready:
            try:
                return process.prepare(unit)
            except Lost as lost:
                where = unit.engine or unit.experiment
                self._unready[place] = Lost(lost.outcome, f"it cannot be compiled for {where} ({lost})")
                self._note(f"{unit.law}: {self._unready[place]}; all its episodes there are {lost.outcome}")
                if isinstance(lost, Ended):
                    raise
        raise self._unready[place]

    def _note(self, text: str) -> None:
        text = "".join(sign if sign.isprintable() else " " for sign in text)  # it may hold what a law raised
        self.notes.append(text)
        print(text, file=sys.stderr)

    @contextlib.contextmanager
    def _process(self, unit: Unit) -> Iterator["Process"]:
        """One that is idle, or a new one, made ready for the unit; it is idle again unless it was lost."""
        try:
            process = self._idle.get_nowait()
        except queue.Empty:
            process = Process(self._chunk)
            self._all.append(process)
        try:
            self._prepare(process, unit)
            yield process
        except Ended:
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
            raise BadLaw(f"--law {self._own[unit.law].origin}: {reason}") from mistake
        else:
            self._idle.put(process)

    @functools.cached_property
    def _chunk(self) -> bytes:
        return json.dumps(described(self.plan, [unit for unit in self.plan.units if self.has(unit)])).encode()
