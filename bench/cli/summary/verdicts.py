"""The paper's claims as a run decides them, counted by verdict."""

from __future__ import annotations

from collections.abc import Iterable

from bench.cli.paragraphs import Paragraph
from bench.findings.claims import Results, judge_possible, tally
from bench.findings.claims.verdict import Word

PLURAL = {
    Word.HOLDS: "hold",
    Word.CORRECTED: "hold with a correction",
    Word.FAILS: "do not hold",
    Word.ANSWERED: "open in 1988 and answered since then",
    Word.DEPENDS: "depend on the gains",
}


def paragraph(results: Results) -> Paragraph:
    """How many claims got each word, by the present criteria and by the first ones; which do not hold."""
    decided, lacks = judge_possible(results)
    every = len(decided) + len(lacks)
    if not decided:
        return Paragraph("Claims", (f"This run decides none of the paper's {every} claims.",))
    failed = ", ".join(one.id for one in decided if one.word == Word.FAILS)
    now = f"Of the paper's {every} claims {_counted(one.word for one in decided)}{f' ({failed})' * bool(failed)}"
    unknown = f"; {len(lacks)} cannot be judged from this run" if lacks else ""
    first = f"By the criteria first written: {_counted(one.first for one in decided)}."
    return Paragraph("Claims", (f"{now}{unknown}.", first))


def _counted(words: Iterable[Word]) -> str:
    """'20 hold, 1 does not hold'."""
    return ", ".join(f"{number} {_verb(word, number)}" for word, number in tally(words).items())


def _verb(word: Word, number: int) -> str:
    return str(word) if number == 1 and word != Word.ANSWERED else PLURAL.get(word, word)
