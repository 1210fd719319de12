"""A user's laws, each in its own processes (sandbox_process.py): one that hangs or dies costs its own rows alone.

Every request has a limit. A unit that was lost is run again one episode after the other, and only those that do not
come back are rows with the outcome `hung` or `crashed`; after MOST_LOST of them, or three that hang, the rest of the
unit counts as lost without being tried, and so does a whole unit without parts, or whose answer is not its
rows (answers.py).

A process that is killed while it prepares is started once more, with no other at work; if it is killed again, its
rows are `crashed` in this run, and the same command tries them again.
"""

import contextlib
import json
import sys
import threading
from collections.abc import Iterable, Iterator

import pyarrow as pa

from bench.base.errors import BadLaw
from bench.experiments.experiment import Unit, experiment_of
from bench.experiments.plan import Plan
from bench.experiments.tables.packed import pack
from bench.experiments.tables.store import joined, lost_table, table_of_unit
from bench.running.ours_first import compile_ours
from bench.running.sandbox_line import Ended, Forged, Killed, Lost, Mistake, Pool, Process
from bench.running.wire_format import described
from tasks.verdict import CRASHED, HUNG, OUTCOMES

PATIENCE_S, SINGLE_S = 30.0, 1.0
"""Time limits of a unit and of a single episode, besides TICK_S for each of their ticks."""

TICK_S = {"": 1e-5, "ideal-rk4": 1e-5, "ideal-held": 1e-5, "native": 1e-4, "reference": 2e-3}
"""Seconds of processor time, by engine: ten times a tick of ours. A perturbed body is simulated as ideal-held is."""

MOST_LOST = 100
"""Episodes of a unit that may be lost one by one, each for SINGLE_S."""

STARTS_ANEW, HANGS = 0.3, 0.34
"""Shares of them for an episode that ended the process, which takes seconds to start and to compile again, and for one
that hung: an endless law costs the limit of its unit and three episodes'."""

LOST = tuple(OUTCOMES[one] for one in (CRASHED, HUNG))
"""The outcomes of episodes that did not come back."""


class Sandbox(contextlib.AbstractContextManager):
    """The processes of a plan's own laws, as many as there are threads that ask; started when first needed.

    limit_s: of processor time for every request; None for the rule above. most_lost: episodes of a unit. notes:
    messages about the laws. again: keys of units whose law was killed twice while it prepared.
    """

    def __init__(self, plan: Plan, limit_s: float | None = None, most_lost: int = MOST_LOST, is_checked: bool = False):
        self.plan, self.limit_s, self.most_lost, self.is_checked = plan, limit_s, most_lost, is_checked
        self.stopping = False
        self.notes: list[str] = []
        self.again: set[str] = set()
        self.reasons: dict[str, str] = {}  # why a law was lost, the first time
        self._own = {one.name: one for one in plan.request.user_laws}
        self._tried: dict[Unit, pa.Table] = {}
        self._unready: dict[str | tuple[str, ...], Lost] = {}
        self._pool = Pool()
        self._compiling, self._is_compiled = threading.Lock(), False

    def __exit__(self, *_: object) -> None:
        self._pool.end_all()

    def has(self, unit: Unit) -> bool:
        """Whether the unit is of a user's law."""
        return unit.law in self._own

    def check(self, units: Iterable[Unit] | None = None) -> None:
        """Compile the laws for every engine that they run on, and try them; BadLaw if one is beyond the dialect.

        A law that is found to be so later than here has changed, and is lost. units: those that are run next, if the
        others may not be run at all.
        """
        self.is_checked = False
        own = [unit for unit in (self.plan.units if units is None else units) if self.has(unit)]
        firsts = {self._place(unit): unit for unit in reversed(own)}
        for unit in reversed(firsts.values()):
            with contextlib.suppress(Lost), self._process(unit):
                pass
        for unit in own:
            if experiment_of(unit).is_tried_first and not unit.arm:
                self._tried[unit] = self.rows(unit)
        self.is_checked = True

    def rows(self, unit: Unit) -> pa.Table:
        """Return the rows of a unit, whatever becomes of its law; BadLaw if it is beyond the dialect."""
        if unit in self._tried:
            return self._tried.pop(unit)
        experiment = experiment_of(unit)
        try:
            return self._rows(unit, unit, PATIENCE_S)
        except Lost as lost:
            self.reasons.setdefault(unit.law, str(lost))
            if not experiment.is_divisible or isinstance(lost, Forged):
                made = self._lost(unit, lost.outcome)
                what = f"its {unit.episodes} episodes are {lost.outcome}"
                self._note(f"{unit.label}: {lost}; {what if made.num_rows else 'it has no rows'}")
                return made
            if self._unready_for(unit):
                return self._lost(unit, lost.outcome)
            self._note(f"{unit.label}, {unit.selector} from {unit.first}: {lost}; its episodes are run singly")
        return joined(list(self._one_by_one(unit)))

    def packed(self, unit: Unit) -> bytes | None:
        """Return the rows of a unit, of a user's law or of ours, as bytes; None if it is to be tried again."""
        made = self.rows(unit) if self.has(unit) else table_of_unit(self.plan.request, unit)
        return None if unit.key in self.again else pack(made, experiment_of(unit).table)

    def _one_by_one(self, unit: Unit) -> Iterator[pa.Table]:
        lost_before, end = 0.0, unit.first + unit.count
        for first in range(unit.first, end):
            if self.stopping:
                raise KeyboardInterrupt
            single = unit.part(first, 1)
            try:
                yield self._rows(unit, single, SINGLE_S)
            except Lost as lost:
                share = HANGS if lost.outcome == OUTCOMES[HUNG] else STARTS_ANEW if isinstance(lost, Ended) else 0.0
                lost_before += max(1.0, MOST_LOST * share)
                gives_up = lost_before >= self.most_lost
                yield self._lost(unit.part(first, end - first) if gives_up else single, lost.outcome)
                if gives_up:
                    return

    def _lost(self, unit: Unit, outcome: str) -> pa.Table:
        return lost_table(self.plan.request, unit, outcome)

    def _rows(self, unit: Unit, some: Unit, patience_s: float) -> pa.Table:
        """Return the rows of some of a unit's episodes."""
        limit_s = patience_s + TICK_S[unit.engine] * experiment_of(unit).ticks(self.plan.request, some)
        if self.limit_s is not None:
            limit_s = self.limit_s if some is unit else min(self.limit_s, limit_s)
        with self._process(unit) as process, self._mistakes(unit):
            return process.ask(unit, some, limit_s)

    def _unready_for(self, unit: Unit) -> Lost | None:
        """Why a law is not compiled for the unit, nor tried again."""
        return self._unready.get(unit.law) or self._unready.get(self._place(unit))

    @staticmethod
    def _place(unit: Unit) -> tuple[str, str, str]:
        """Return what a law is compiled for."""
        return unit.experiment, unit.contender, unit.engine

    def _prepared(self, unit: Unit) -> Process:
        """Return a process that is ready for the unit; a law that hangs or ends its process is lost everywhere."""
        try:
            try:
                return self._prepared_once(unit)
            except Killed as killed:
                self._note(f"{unit.law}: {killed}; it is tried once more, alone")
            with self._pool.alone():
                return self._prepared_once(unit)
        except Lost as lost:
            is_everywhere = isinstance(lost, Ended) or lost.outcome == OUTCOMES[HUNG]
            where, there = ("", "") if is_everywhere else (f"for {unit.engine or unit.experiment} ", " there")
            known = type(lost)(lost.outcome, f"it cannot be compiled {where}({lost})")
            self._unready[unit.law if is_everywhere else self._place(unit)] = known
            self._note(f"{unit.law}: {known}; all its episodes{there} are {lost.outcome}")
            raise self._known(unit, known) from lost

    def _prepared_once(self, unit: Unit) -> Process:
        process = self._pool.take(unit.law, self._begin)
        try:
            with self._mistakes(unit):
                process.prepare(unit)
        except BaseException as error:
            self._pool.give_back(process, isinstance(error, Ended))
            raise
        return process

    def _begin(self, law: str) -> Process:
        self._compile_ours()
        mine = [one for one in self.plan.units if one.law == law]
        return Process(law, self.plan.request, json.dumps(described(self.plan, mine)).encode())

    def _compile_ours(self) -> None:
        """Compile our code that the laws need before the first process of one starts; see `ours_first`."""
        with self._compiling:
            if not self._is_compiled:
                compile_ours(self.plan, [unit for unit in self.plan.units if self.has(unit)])
                self._is_compiled = True

    def _known(self, unit: Unit, lost: Lost) -> Lost:
        """Return why a unit is lost; note that it is to be tried again if its law may not be why."""
        if isinstance(lost, Killed):
            self.again.add(unit.key)
        return lost

    @contextlib.contextmanager
    def _mistakes(self, unit: Unit) -> Iterator[None]:
        """Name the user's file in a mistake, for the process has the law in another; see `check`."""
        try:
            yield
        except Mistake as mistake:
            reason = str(mistake).partition(": ")[2] or str(mistake)
            if self.is_checked:
                raise Lost(OUTCOMES[CRASHED], f"it was sound before ({reason})") from mistake
            raise BadLaw(f"--law {self._own[unit.law].origin}: {reason}") from mistake

    def _note(self, text: str) -> None:
        text = "".join(sign if sign.isprintable() else " " for sign in text)  # it may hold what a law raised
        self.notes.append(text)
        print(text, file=sys.stderr)

    @contextlib.contextmanager
    def _process(self, unit: Unit) -> Iterator[Process]:
        """One that is made ready for the unit; it is idle again unless it was lost."""
        if known := self._unready_for(unit):
            raise self._known(unit, known)
        with self._pool.turns:
            process, has_ended = self._prepared(unit), False
            try:
                yield process
            except Ended:
                has_ended = True
                raise
            finally:
                self._pool.give_back(process, has_ended)
