"""Rows of users' laws, made in processes of their own: a law that hangs or dies loses rows of its own alone.

A unit is run in stretches of 25 starts, each a request with a limit. A stretch that does not come
back is lost: all its episodes are rows with the outcome `hung` or `crashed`. So is a unit that cannot
be cut, and an answer that is not the rows asked for (answers.py). After three lost stretches of a law, all
that is left of its units counts as the third did, without being tried, and this is said once.

Where a process is killed, perhaps by the system for want of memory, what it was asked is tried once
more, with no other process of these at work. If it is killed again, all rows of the unit are
`crashed` in this run, and the same command tries them again. Such losses are counted apart from the
others; after three, the rest of the law waits for the same command, too.

Limitations: which stretches of a law come after its third lost one depends on the order in which
they are run: with parallel threads, after an interruption (the losses before it are not counted),
and on a cluster, where each chunk of units counts for itself, other rows of such a law may be lost.
Rows of other laws do not depend on it.
"""

import contextlib
import sys
import threading
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from typing import TypeVar

import pyarrow as pa

from bench.base.errors import BadLaw
from bench.base.isolated import CRASHED, HUNG, KILLED, NoAnswer, Refused
from bench.experiments.experiment import Unit, experiment_of
from bench.experiments.plan import Plan
from bench.experiments.tables.packed import pack
from bench.experiments.tables.store import joined, lost_table, table_of_unit
from bench.running.ours_first import compile_ours
from bench.running.sandbox.pool import LawProcess, Pool
from bench.running.wire_format import described

STRETCH = 25
"""Starts that are run together, and lost together."""

MOST_LOST = 3
"""Stretches of a law that may be lost before the rest is not tried: a law that never returns costs
the limits of so many."""

UNIT_S, STRETCH_S = 30.0, 10.0
"""Limits of a unit that cannot be cut and of a stretch, besides TICK_S for each of their ticks."""

TICK_S = {
    "": 1e-5,
    "ideal-rk4": 1e-5,
    "ideal-held": 1e-5,
    "native": 1e-4,
    "reference": 2e-3,
}
"""Seconds of processor time, by engine: ten times a tick of ours. A perturbed body is simulated as
ideal-held is."""

Answer = TypeVar("Answer")

LOST = (CRASHED, HUNG)
"""The outcomes of episodes that did not come back; they are words of `tasks.verdict.OUTCOMES`."""


class Sandbox(contextlib.AbstractContextManager):
    """The processes of a plan's user laws, as many as there are threads that ask.

    They are started when they are first needed.

    Attributes:
        plan: With the words of the laws.
        limit_s: Of processor time for every request; None for the rule above.
        is_checked: Whether every law was found to be within the dialect.
        stopping: Whether no more is to be begun.
        notes: Messages about the laws.
        again: Keys of units whose process was killed twice.
        reasons: Law -> why it was lost, the first time.
    """

    def __init__(self, plan: Plan, limit_s: float | None = None, is_checked: bool = False):
        self.plan = plan
        self.limit_s = limit_s
        self.is_checked = is_checked
        self.stopping = False
        self.notes: list[str] = []
        self.again: set[str] = set()
        self.reasons: dict[str, str] = {}
        self._laws = {law.name: law for law in plan.request.user_laws}
        self._tried: dict[Unit, pa.Table] = {}
        # Why nothing more is tried of a law, everywhere or at a place.
        self._given_up: dict[str | tuple[str, ...], NoAnswer] = {}
        # Of a law, and whether the process was killed.
        self._losses: Counter[tuple[str, bool]] = Counter()
        self._counting = threading.Lock()
        self._pool = Pool()
        self._is_compiled = False

    def __exit__(self, *_: object) -> None:
        self._pool.end_all()

    def has(self, unit: Unit) -> bool:
        """Return whether the unit is of a user's law."""
        return unit.law in self._laws

    def check(self, units: Iterable[Unit] | None = None) -> None:
        """Compile the laws for every engine that they run on, and try them.

        A law that is found to be beyond the dialect later than here has changed, and is lost.

        Args:
            units: Those that are run next, if the others may not be run at all.

        Errors:
            BadLaw: A law is beyond the dialect.
        """
        self.is_checked = False
        users = [unit for unit in (self.plan.units if units is None else units) if self.has(unit)]
        firsts: dict[tuple[str, ...], Unit] = {}
        for unit in users:
            firsts.setdefault(place_of(unit), unit)
        for unit in firsts.values():
            if self._given_up_for(unit) is None:
                with contextlib.suppress(NoAnswer), self._pool.turns:
                    self._prepare(unit)
        for unit in users:
            if experiment_of(unit).is_tried_first and not unit.arm:
                self._tried[unit] = self.rows(unit)
        self.is_checked = True

    def rows(self, unit: Unit) -> pa.Table:
        """Return the rows of a unit, whatever becomes of its law; BadLaw: beyond the dialect."""
        if unit in self._tried:
            return self._tried.pop(unit)
        tables = []
        for stretch in cut(unit):
            if self.stopping:
                raise KeyboardInterrupt
            tables.append(self._rows(unit, stretch))
        return joined(tables)

    def packed(self, unit: Unit) -> bytes | None:
        """Return the rows of a unit, of any law, as bytes; None if it is to be tried again."""
        if self.has(unit):
            table = self.rows(unit)
        else:
            table = table_of_unit(self.plan.request, unit)
        if unit.key in self.again:
            return None
        return pack(table, experiment_of(unit).table)

    def _rows(self, unit: Unit, stretch: Unit) -> pa.Table:
        """Return the rows of a stretch of a unit, lost or not."""
        error = self._given_up_for(unit)
        if error is None:
            try:
                limit_s = self._limit_s(unit, stretch)
                with self._pool.turns:
                    self._prepare(unit)
                    return self._ask(unit, lambda law: law.make_rows(unit, stretch, limit_s))
            except NoAnswer as no_answer:
                error = no_answer
                self._note_loss(unit, stretch, error)
        if error.fate == KILLED:
            self.again.add(unit.key)
        return lost_table(self.plan.request, stretch, outcome_of(error))

    def _limit_s(self, unit: Unit, stretch: Unit) -> float:
        """Return the processor time of a stretch."""
        if self.limit_s is not None:
            return self.limit_s
        experiment = experiment_of(unit)
        ticks = experiment.ticks(self.plan.request, stretch)
        patience_s = STRETCH_S if experiment.is_divisible else UNIT_S
        return patience_s + TICK_S[unit.engine] * ticks

    def _note_loss(self, unit: Unit, stretch: Unit, error: NoAnswer) -> None:
        """Say what is lost; after MOST_LOST losses of a law, give it up and say so once."""
        law = unit.law
        self.reasons.setdefault(law, str(error))
        if self._given_up_for(unit) is not None:
            # The law could not be compiled, or was lost too often, which was said.
            return
        outcome = outcome_of(error)
        rows = lost_table(self.plan.request, stretch, outcome).num_rows
        what = f"its {stretch.episodes} episodes are {outcome}" if rows else "it has no rows"
        where = unit.label
        if experiment_of(unit).is_divisible:
            where += f", {unit.selector} from {stretch.first}"
        is_killed = error.fate == KILLED
        later = "; the same command tries them again" if is_killed else ""
        self._note(f"{where}: {error}; {what}{later}")
        times = f"it was lost {MOST_LOST} times"
        with self._counting:
            self._losses[law, is_killed] += 1
            if law in self._given_up or self._losses[law, is_killed] < MOST_LOST:
                return
            self._given_up[law] = NoAnswer(error.fate, f"{times} ({error})")
        self._note(f"{law}: {times}; its other episodes count as {outcome} and are not tried{later}")

    def _given_up_for(self, unit: Unit) -> NoAnswer | None:
        """Return why nothing more is tried of a unit's law."""
        return self._given_up.get(unit.law) or self._given_up.get(place_of(unit))

    def _prepare(self, unit: Unit) -> None:
        """Make a process ready for the unit.

        Errors:
            NoAnswer: The law hangs or ends its process, and is given up everywhere; or it raises
                while it is compiled, and is given up at this place.
        """
        try:
            self._ask(unit, lambda law: law.prepare(unit))
        except NoAnswer as error:
            key: str | tuple[str, ...] = unit.law
            where = there = ""
            if not error.is_over and error.fate != HUNG:
                key = place_of(unit)
                where, there = f"for {unit.engine or unit.experiment} ", " there"
            known = NoAnswer(error.fate, f"it cannot be compiled {where}({error})")
            self._given_up[key] = known
            self._note(f"{unit.law}: {known}; all its episodes{there} are {outcome_of(known)}")
            raise known from error

    def _ask(self, unit: Unit, question: Callable[[LawProcess], Answer]) -> Answer:
        """Return what a process of the unit's law answers; asked again, alone, if it was killed."""
        try:
            with self._process(unit) as process:
                return question(process)
        except NoAnswer as error:
            if error.fate != KILLED:
                raise
            show(f"{unit.law}: {error}; it is tried once more, alone")
        with self._pool.alone(), self._process(unit) as process:
            return question(process)

    @contextlib.contextmanager
    def _process(self, unit: Unit) -> Iterator[LawProcess]:
        """Yield a process of the unit's law; a mistake in it names the user's file."""
        try:
            with self._pool.lend(unit.law, self._begin) as process:
                yield process
        except Refused as mistake:
            # It names the file that the process has made of the law's text.
            reason = str(mistake).partition(": ")[2] or str(mistake)
            if self.is_checked:
                raise NoAnswer(CRASHED, f"it was sound before ({reason})") from mistake
            raise BadLaw(f"--law {self._laws[unit.law].origin}: {reason}") from mistake

    def _begin(self, law: str) -> LawProcess:
        """Start a process, after our code that the laws need was compiled without them."""
        if not self._is_compiled:
            compile_ours(self.plan, [unit for unit in self.plan.units if self.has(unit)])
            self._is_compiled = True
        units = [unit for unit in self.plan.units if unit.law == law]
        return LawProcess(law, self.plan.request, described(self.plan, units))

    def _note(self, text: str) -> None:
        self.notes.append(show(text))


def show(text: str) -> str:
    """Print a message, which may hold what a law raised, and return what of it can be printed."""
    printable = "".join(letter if letter.isprintable() else " " for letter in text)
    print(printable, file=sys.stderr)
    return printable


def cut(unit: Unit) -> list[Unit]:
    """Return the stretches that a unit is run in; the unit itself where it cannot be cut."""
    if not experiment_of(unit).is_divisible or unit.count <= STRETCH:
        return [unit]
    end = unit.first + unit.count
    return [unit.part(first, min(STRETCH, end - first)) for first in range(unit.first, end, STRETCH)]


def place_of(unit: Unit) -> tuple[str, str, str]:
    """Return what a law is compiled for."""
    return unit.experiment, unit.contender, unit.engine


def outcome_of(error: NoAnswer) -> str:
    """Return the outcome of the episodes that an error took."""
    return HUNG if error.fate == HUNG else CRASHED
