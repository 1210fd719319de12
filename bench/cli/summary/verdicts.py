"""The paper's claims as a run decides them, counted by verdict."""

from __future__ import annotations

from bench.cli.paragraphs import Paragraph
from bench.findings.claims import Results, judge_possible, told
from bench.findings.claims.verdict import Word


def paragraph(results: Results) -> Paragraph:
    """How many claims got each word, by the present criteria and by the first ones; which do not hold."""
    decided, lacks = judge_possible(results)
    every = len(decided) + len(lacks)
    if not decided:
        return Paragraph("Claims", (f"This run decides none of the paper's {every} claims.",))
    failed = ", ".join(one.id for one in decided if one.word == Word.FAILS)
    now = f"Of the paper's {every} claims {told(one.word for one in decided)}"
    now += f". What does not hold: {failed}" if failed else ""
    unknown = f"; {len(lacks)} cannot be judged from this run" if lacks else ""
    first = told(one.first for one in decided)
    return Paragraph("Claims", (f"{now}{unknown}. By the criteria first written: {first}.",))
