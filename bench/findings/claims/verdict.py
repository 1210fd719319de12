"""What a claim is, what can be said of it, and on what evidence.

A claim's text and its numbers were committed before any result was looked at; `git log` of its file shows it.
"""

from collections.abc import Callable, Mapping
from enum import StrEnum
from types import MappingProxyType
from typing import NamedTuple

from bench.errors import BenchError


class Word(StrEnum):
    """The three things that can be said of a claim."""

    HOLDS = "holds"
    CORRECTED = "holds with a correction"
    FAILS = "does not hold"


def word_of(holds: object, corrected: object) -> Word:
    """What a criterion of two parts comes to: the first alone decides, if it is met."""
    return Word.HOLDS if holds else Word.CORRECTED if corrected else Word.FAILS


class NoEvidence(BenchError):
    """A claim asked of tables that hold nothing about it: an error, never a pass."""


class Evidence(NamedTuple):
    """Why the word is what it is.

    sentence: plain prose, every number in it computed. rows: table rows, states and episodes looked at. tables: where
    they come from; "experiment" for what the claim computes itself. parts: of the sentence, by name, for the book.
    """

    sentence: str
    rows: int
    tables: tuple[str, ...]
    parts: Mapping[str, str] = MappingProxyType({})

    def __str__(self) -> str:
        return self.sentence


class Claim(NamedTuple):
    """One sentence of the paper and how it is decided.

    sentence: our paraphrase. criterion: what makes it hold, hold with a correction, or not hold, in numbers.
    open: what the paper leaves open and how the verdict hangs on it. readings: where there are several.
    judge: results -> (word, evidence).
    """

    id: str
    section: str
    sentence: str
    question: str
    criterion: str
    judge: Callable
    open: str = ""
    readings: tuple[str, ...] = ()


def claim(
    *, id: str, section: str, sentence: str, question: str, criterion: str, open: str = "", readings: tuple = ()
) -> Callable[[Callable], Claim]:
    """Makes the function below, which judges it, a Claim; its texts may be broken into lines as the file likes."""

    def joined(text: str) -> str:
        return " ".join(text.split())

    texts = (id, section, joined(sentence), joined(question), joined(criterion))
    return lambda judge: Claim(*texts, judge, joined(open), tuple(map(joined, readings)))


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
