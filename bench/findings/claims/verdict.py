"""What a claim is, what can be said of it, and on what evidence.

A module of claims holds the limits and what is made of the rows. The texts of its claims stand in the TOML file of the
same name beside it, with names of the module in braces; criteria that stood before are in history.toml.
"""

import functools
import importlib
import inspect
import re
import tomllib
from collections.abc import Callable
from enum import StrEnum
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

from bench.base.errors import NoEvidence
from bench.findings.amounts import join_words


class Word(StrEnum):
    """What can be said of a claim. A correction is of the paper, and the claim names it."""

    HOLDS = "holds"
    CORRECTED = "holds with a correction"
    FAILS = "does not hold"
    ANSWERED = "open in 1988; answered since"
    DEPENDS = "depends on the gains"
    READING = "depends on how it is read"
    UNTESTABLE = "not testable"
    UNTESTED = "not tested"


PLURAL = {
    Word.HOLDS: "hold",
    Word.CORRECTED: "hold with a correction",
    Word.FAILS: "do not hold",
    Word.ANSWERED: "were open in 1988 and are answered since",
    Word.DEPENDS: "depend on the gains",
    Word.READING: "depend on how they are read",
    Word.UNTESTABLE: "are not testable",
    Word.UNTESTED: "are not tested",
}


def verb_phrase(word: Word, number: int) -> str:
    """Return the verb of a number of claims with a word: "holds" of one, "hold" of several."""
    if (word, number) == (Word.ANSWERED, 1):
        return "was open in 1988 and is answered since"
    if number == 1 and word in (Word.UNTESTABLE, Word.UNTESTED):
        return f"is {word}"
    return str(word) if number == 1 else PLURAL[word]


MISPRINTS = """
    We have a rule for errors of the paper. If only a symbol in the paper's statement is wrong, the claim "holds with a
    correction". The claim also "holds with a correction" if the statement is wrong, but other equations or sentences of
    the paper are right. If the statement is false in substance, the claim "does not hold".
    """
"""The rule of C10, C14, C15, C16 and C18."""


def word_of(holds: object, corrected: object) -> Word:
    """Return what a criterion of two parts comes to: the first alone decides, if it is met."""
    return Word.HOLDS if holds else Word.CORRECTED if corrected else Word.FAILS


LONGEST_MEASURED = 240
"""Characters of what was measured: one sentence or two, which a cell of a table holds."""


class Evidence(NamedTuple):
    """Why the word is what it is.

    sentence: plain prose, every number in it computed. rows: table rows, states and episodes looked at. tables: where
    they come from, if not those that the claim's texts name.
    instead: what is true, written from the rows; empty where the claim's own text says it.
    measured: the number that decides, with its unit, and its 95 % interval where it is of a sample: whole sentences.
    numbers: a table of all numbers, heads first, where prose would be a log. chosen: the rows that were read of each
    table, a condition as pandas.DataFrame.query takes it; empty where all rows were read.
    """

    sentence: str
    rows: int
    tables: tuple[str, ...] = ()
    instead: str = ""
    measured: str = ""
    numbers: tuple[tuple[str, ...], ...] = ()
    chosen: tuple[tuple[str, str], ...] = ()

    def __str__(self) -> str:
        return self.sentence


class Earlier(NamedTuple):
    """A criterion that stood before.

    written: date and commit. criterion: in short, and why it was given up. word: what it gave when it was given up.
    """

    written: str
    criterion: str
    word: Word

    def __str__(self) -> str:
        """Return the criterion, why it was given up, and what came out by it."""
        return f'{self.criterion} By that earlier criterion, the verdict was "{self.word}".'


SECTION = re.compile(r"\d+(?:\.\d+)?")
"""The first section that a claim's `section` names."""


class Claim(NamedTuple):
    """One sentence of the paper and how it is decided.

    sentence: our paraphrase. criterion: what each word takes, in numbers. open: what the paper leaves open and how the
    verdict depends on it. readings: where there are several. judge: run -> (word, evidence). quote: the paper's own
    words; section and equation: where they stand; value: the paper's number. correction: of the paper, what is said
    when the claim holds with one; empty: no criterion of it leads there. instead: what is true where it does not hold,
    or on what it depends. written: date and commit of the criterion. replay: the command that makes the episodes again
    that decide; empty: that of the whole run.
    """

    id: str
    section: str
    sentence: str
    criterion: str
    judge: Callable
    open: str = ""
    readings: tuple[str, ...] = ()
    quote: str = ""
    equation: str = ""
    value: str = "none given"
    correction: str = ""
    instead: str = ""
    written: str = ""
    earlier: tuple[Earlier, ...] = ()
    replay: str = ""

    @property
    def paper_order(self) -> tuple:
        """What claims are sorted by to have them in the order of the paper: the abstract is first, section 2 next."""
        found = SECTION.search(self.section)
        number = tuple(map(int, found[0].split("."))) if found else ()
        return number, self.id

    @property
    def place(self) -> str:
        """Section and equation: 'sections 3.0 and 3.4, equation (3.7)', or 'abstract'."""
        parts = self.section.split(", ")
        section = f"section{'s' * (len(parts) > 1)} {join_words(parts)}" if self.paper_order[0] else self.section
        equations = f"equation{'s' * (self.equation.count('(') > 1)} {self.equation}" if self.equation else ""
        return f"{section}{', ' * bool(equations)}{equations}"


def claim(id: str) -> Callable[[Callable], Claim]:
    """Return a decorator that makes a judging function the claim of this id, with the texts beside its module."""

    def with_texts(judge: Callable) -> Claim:
        its = inspect.unwrap(judge).__globals__
        names = Names(its)

        def text(template: str) -> str:
            return " ".join(template.format_map(names).split())

        texts = dict(read_texts(Path(names["__file__"]).with_suffix(".toml"))[id])
        readings, tables = tuple(map(text, texts.pop("readings", ()))), tuple(texts.pop("tables", ()))
        earlier = tuple(
            Earlier(old["written"], " ".join(old["criterion"].split()), Word(old["word"]))
            for old in read_texts(HISTORY).get(id, ())
        )

        @functools.wraps(judge)
        def judged(run: Any) -> tuple[Word, Evidence]:
            run.chosen.clear()
            word, found = judge(run)
            found = found._replace(tables=found.tables or tables)
            chosen = (rows for rows in run.chosen if rows[0] in found.tables)
            return word, found._replace(chosen=tuple(dict.fromkeys(chosen)))

        written = {name: text(words) for name, words in texts.items()}
        return Claim(id, judge=judged, readings=readings, earlier=earlier, **written)

    return with_texts


class Names(dict[str, Any]):
    """The names of a module that texts may hold in braces; any other name is a module of claims."""

    def __missing__(self, name: str) -> ModuleType:
        return importlib.import_module(f"{__package__}.{name}")


HISTORY = Path(__file__).with_name("history.toml")


@functools.cache
def read_texts(path: Path) -> dict[str, Any]:
    """Return what a TOML file says, by the id of the claim."""
    return tomllib.loads(path.read_text(encoding="utf-8"))


class Verdict(NamedTuple):
    """A claim decided."""

    claim: Claim
    word: Word
    evidence: Evidence

    @property
    def id(self) -> str:
        """The claim's."""
        return self.claim.id

    @property
    def rows(self) -> int:
        """The evidence's."""
        return self.evidence.rows

    @property
    def correction(self) -> str:
        """What is true of the paper's sentence where it does not hold as it stands; else nothing."""
        if self.evidence.instead:
            return self.evidence.instead
        if self.word in (Word.FAILS, Word.DEPENDS):
            return self.claim.instead or self.claim.correction
        return self.claim.correction if self.word == Word.CORRECTED else ""

    @property
    def measured(self) -> str:
        """The evidence's."""
        return self.evidence.measured or str(Word.UNTESTED)

    @property
    def first(self) -> Word:
        """The word by the criterion that was written first."""
        return self.claim.earlier[0].word if self.claim.earlier else self.word


def decide(claim: Claim, run: Any) -> Verdict:
    """Judge one claim on a run; NoEvidence: its tables hold no row about it.

    A claim that says itself that it is not tested needs no row.
    """
    word, evidence = claim.judge(run)
    if evidence.rows < 1 and word != Word.UNTESTED:
        raise NoEvidence(
            f"{claim.id}: no row of {', '.join(evidence.tables) or 'any table'} speaks of it; run "
            "the suite 'quick', 'default' or 'full' without narrowing it"
        )
    return Verdict(claim, word, evidence)
