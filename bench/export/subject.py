"""Subjects of the export: a law, coordinates, an impedance or a spring, with its entries as functions.

find_subject("feedback-linearized/zyx-euler"), find_subject("representation-mrp"), find_subject("impedance-geometric")
"""

import functools
from collections.abc import Callable
from typing import Any, NamedTuple

from bench.base.errors import UnknownWord
from bench.export.entries import Entry, of_impedance, of_law
from bench.export.sprung import of_compensator, of_representation, of_spring
from bench.law.contender import Contender
from bench.law.contenders import registry
from bench.law.contenders.registry import contenders
from bench.law.control.registry import all_controllers
from bench.law.inputs import NO_MEMORY, Gains, Tuning
from bench.law.kinds import HasLaw, Law
from bench.law.so3 import Rotation
from bench.translation.kinds import REAL, Kind, Tuple, numbers
from bench.translation.program import Program

IMPEDANCE, COMPENSATOR, SPRING = "impedance-", "compensator-", "spring-"

ALONE: dict[str, tuple[str, Callable[[Any], list[Entry]]]] = {
    "representation-": ("representations", of_representation),
    COMPENSATOR: ("compensators", lambda one: of_compensator(one.law.law, one.begin)),
    SPRING: ("springs", lambda one: of_spring(one.moment)),
}
"""Kinds by what their words begin with: the folder of each, and the entries of a record."""


class Subject(NamedTuple):
    """One thing to export.

    record: the constant of its file, or the law that this has. representation: the coordinates it acts on, or None.
    """

    word: str
    record: Any
    representation: Any
    entries: tuple[Entry, ...]
    memory: tuple | None = None
    contender: Contender | None = None

    @property
    def identifier(self) -> str:
        """Return the word as a name in every language."""
        return identifier_of(self.word)

    @property
    def memory_name(self) -> str:
        """Return the name of the memory, which ends in _wxyz if it is a quaternion; empty without memory."""
        return next((one.name for each in self.entries for one in each.parameters if one.kind == "memory"), "")


def identifier_of(word: str) -> str:
    """Return the word of a subject as a name in every language."""
    return word.replace("-", "_").replace("/", "_")


def subject_words(extra: tuple[Law, ...] = ()) -> list[str]:
    """Return the words of everything that can be exported."""
    laws = [one.name for one in registry.all_contenders(extra)]
    impedances = [one.name for one in all_controllers() if one.impedance is not None]
    alone = (f"{prefix}{name}" for prefix, (folder, _) in ALONE.items() for name in contenders(folder))
    return [*laws, *impedances, *alone]


def find_subject(word: str, extra: tuple[Law, ...] = ()) -> Subject:
    """Return the subject of a word; Incompatible if coordinates are missing or do not fit."""
    first, _, second = word.partition("/")
    for prefix, (folder, entries_of) in ALONE.items():
        if first.startswith(prefix) and first.removeprefix(prefix) in contenders(folder):
            record = contenders(folder)[first.removeprefix(prefix)]
            entries = tuple(entries_of(record))
            return Subject(word, record.law if isinstance(record, HasLaw) else record, None, entries)
    if first.startswith(IMPEDANCE) and first.removeprefix(IMPEDANCE) in contenders("impedances"):
        impedance = contenders("impedances")[first.removeprefix(IMPEDANCE)]
        along = registry.representation(second) if second else None
        law = impedance.law_in(along) if along and impedance.law_in else impedance.law
        if law is None:
            words = [one for one in subject_words() if one.startswith(f"{first}/")]
            raise UnknownWord("impedance", word, words)
        return Subject(word, impedance, along, tuple(of_impedance(law)))
    if first not in {one.name for one in (*registry.contenders("regulators").values(), *extra)}:
        raise UnknownWord("law to export", word, subject_words(extra))
    contender = registry.find_contender(word, extra)
    regulator = contender.regulator
    memory = regulator.memory and (*regulator.memory, *NO_MEMORY[len(regulator.memory) :])
    entries = tuple(of_law(contender.law, memory))
    return Subject(contender.on_free_body, regulator, contender.representation, entries, memory, contender)


MATRIX = Tuple((numbers(3),) * 3, Rotation.__name__, Rotation._fields)
GAINS = Tuple((REAL, REAL), Gains.__name__, Gains._fields)
TUNING = Tuple((REAL,) * 4, Tuning.__name__, Tuning._fields)
KINDS: dict[str, Kind] = {"matrix": MATRIX, "gains": GAINS, "tuning": TUNING, "number": REAL}
"""Kinds of the arguments of entries; those of others are numbers."""


@functools.lru_cache(maxsize=128)
def translated(subject: Subject) -> Program:
    """Translate all that a subject calls, once a subject."""
    program = Program()
    for entry in subject.entries:
        kinds = tuple(KINDS.get(one.kind, numbers(one.size)) for one in entry.parameters)
        program.entries[entry.name] = program.add(entry.function, kinds)
    return program
