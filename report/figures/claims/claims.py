"""The verdicts on a page: how many of each, and the table. All words are the claim's own."""

from __future__ import annotations

from bench.findings import claims
from bench.findings.claims import Verdict, Word, tally
from bench.findings.claims.verdict import does
from report.figures.kit import html
from report.figures.kit.page import Run
from report.figures.kit.spelling import prose
from report.figures.kit.tables import Table

ORDER = (Word.FAILS, Word.DEPENDS, Word.CORRECTED, Word.UNTESTABLE, Word.ANSWERED, Word.HOLDS)
"""Order of the table's rows."""

VERDICTS = Table("Claim | What the paper states, in our words | Verdict | What is true instead")
EVIDENCE = "appendix-claims.html"


def facts(_: Run) -> dict:
    """Return how many are decided, how, and how many by a criterion that is not the first."""
    every = claims.judge_all()
    changed = [one for one in every if one.claim.earlier]
    return {
        "decided": len(every),
        "words": claims.told(one.word for one in every),
        "first_words": claims.told(one.first for one in every),
        "changed": len(changed),
        "turned": sum(one.word != one.first for one in changed),
    }


def tables(_: Run) -> dict:
    """Return how many verdicts there are of each kind, and a row a claim."""
    every = claims.judge_all()
    return {"tiles": tiles(every), "verdicts": table(every)}


def tiles(every: list[Verdict]) -> html.Html:
    """Count the statements that were decided, and each verdict by the present criteria and by the first ones."""
    now, first = (tally(words) for words in ([one.word for one in every], [one.first for one in every]))
    entries = [("plain", len(every), "statements of the paper decided")]
    entries += [
        (
            html.VERDICTS[word],
            now.get(word, 0),
            f"{does(word, now.get(word, 0))} (first criteria: {first.get(word, 0)})",
        )
        for word in Word
        if word in now or word in first
    ]
    tile = '<div class="tile {}"><b>{}</b><span>{}</span></div>'
    return html.Html(f'<div class="tiles">{"".join(tile.format(*entry) for entry in entries)}</div>')


def table(every: list[Verdict]) -> html.Markdown | None:
    """Return a row a claim, refuted ones first: number and section, statement, verdicts, and what is true."""
    return VERDICTS(
        (
            f'<a href="{EVIDENCE}#{anchor(one)}">{one.claim.id}</a>',
            prose(one.claim.sentence),
            f"{html.badge(str(one.word))}{'' if one.first == one.word else f'<br>first: {one.first}'}",
            prose(one.correction) if one.correction else "",
        )
        for one in sorted(every, key=lambda one: ORDER.index(one.word))
    )


def anchor(one: Verdict) -> str:
    """Return what a claim's section is called in links."""
    return one.claim.id.lower()
