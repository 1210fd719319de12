"""What a claim is, what can be said of it, and on what evidence.

A claim says when its criterion was written, and what stood before; `git log` of its file shows it.
"""

from collections.abc import Callable, Mapping
from enum import StrEnum
from types import MappingProxyType
from typing import NamedTuple

from bench.errors import BenchError


class Word(StrEnum):
    """What can be said of a claim. A correction is of the paper, and the claim names it."""

    HOLDS = "holds"
    CORRECTED = "holds with a correction"
    FAILS = "does not hold"
    ANSWERED = "open in 1988; answered since"
    DEPENDS = "depends on the gains"
    UNTESTABLE = "not testable"


PLURAL = {
    Word.HOLDS: "hold",
    Word.CORRECTED: "hold with a correction",
    Word.FAILS: "do not hold",
    Word.ANSWERED: "were open in 1988 and are answered since",
    Word.DEPENDS: "depend on the gains",
    Word.UNTESTABLE: "are not testable",
}


def does(word: Word, number: int) -> str:
    """What so many statements with a word do."""
    return (
        "was open in 1988 and is answered since"
        if (word, number) == (Word.ANSWERED, 1)
        else (str(word) if number == 1 else PLURAL[word])
    )


MISPRINTS = """
    A slip of symbol, or a misprint that the paper's own other equations or sentences correct, makes "holds with a
    correction"; a false statement of substance makes "does not hold".
    """
"""The rule of C10, C14, C15, C16 and C18."""


def word_of(holds: object, corrected: object) -> Word:
    """What a criterion of two parts comes to: the first alone decides, if it is met."""
    return Word.HOLDS if holds else Word.CORRECTED if corrected else Word.FAILS


class NoEvidence(BenchError):
    """A claim asked of tables that hold nothing about it: an error, never a pass."""


class Evidence(NamedTuple):
    """Why the word is what it is.

    sentence: plain prose, every number in it computed. rows: table rows, states and episodes looked at. tables: where
    they come from; "experiment" for what the claim computes itself. parts: of the sentence, by name, for the book.
    earlier: the words by those of the claim's earlier criteria that are still computed, in their order.
    """

    sentence: str
    rows: int
    tables: tuple[str, ...]
    parts: Mapping[str, str] = MappingProxyType({})
    earlier: tuple[Word, ...] = ()

    def __str__(self) -> str:
        return self.sentence


class Earlier(NamedTuple):
    """A criterion that stood before.

    written: date and commit. criterion: in short, and why it was given up. word: what it gave when it was given up;
    None where it is still computed.
    """

    written: str
    criterion: str
    word: Word | None = None


class Claim(NamedTuple):
    """One sentence of the paper and how it is decided.

    sentence: our paraphrase. criterion: what each word takes, in numbers. open: what the paper leaves open and how the
    verdict depends on it. readings: where there are several. judge: results -> (word, evidence). quote: the paper's own
    words; section and equation: where they stand; value: the paper's number. correction: of the paper, what is said
    when the claim holds with one; empty: no criterion of it leads there. instead: what is true where it does not hold,
    or on what it depends. written: date and commit of the criterion.
    """

    id: str
    section: str
    sentence: str
    question: str
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

    @property
    def place(self) -> str:
        """Section and equation."""
        return f"section {self.section}{', ' * bool(self.equation)}{self.equation}"


def claim(
    *,
    id: str,
    section: str,
    sentence: str,
    question: str,
    criterion: str,
    readings: tuple[str, ...] = (),
    earlier: tuple[Earlier, ...] = (),
    **texts: str,
) -> Callable[[Callable], Claim]:
    """Makes the function below, which judges it, a Claim; its texts may be broken into lines as the file likes."""

    def joined(text: str) -> str:
        return " ".join(text.split())

    first = (id, section, joined(sentence), joined(question), joined(criterion))
    before = tuple(one._replace(criterion=joined(one.criterion)) for one in earlier)
    others = {name: joined(text) for name, text in texts.items()}
    return lambda judge: Claim(*first, judge, readings=tuple(map(joined, readings)), earlier=before, **others)


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
        if self.word in (Word.FAILS, Word.DEPENDS):
            return self.claim.instead or self.claim.correction
        return self.claim.correction if self.word == Word.CORRECTED else ""

    @property
    def first(self) -> Word:
        """The word by the criterion that was written first."""
        return self.earlier[0][1] if self.earlier else self.word

    @property
    def earlier(self) -> list[tuple[Earlier, Word]]:
        """The criteria that stood before, each with its word."""
        computed = iter(self.evidence.earlier)
        return [(one, one.word or next(computed)) for one in self.claim.earlier]


def decide(claim: Claim, results) -> Verdict:
    """Judge one claim on a run's results.

    Errors:
        NoEvidence: the tables hold no row about it.
    """
    word, evidence = claim.judge(results)
    if evidence.rows < 1:
        raise NoEvidence(
            f"{claim.id}: no row of {', '.join(evidence.tables) or 'any table'} speaks of it; run the suite "
            "'quick', 'default' or 'full' without narrowing it"
        )
    return Verdict(claim, word, evidence)
