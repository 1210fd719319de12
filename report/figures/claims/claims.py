"""The verdicts on a page: how many of each, and the table. All words are the claim's own."""

from bench.findings import claims
from bench.findings.claims import Verdict, Word
from report.figures.kit import html
from report.figures.kit.page import Run
from report.figures.kit.spelling import prose

ORDER = (
    Word.FAILS,
    Word.DEPENDS,
    Word.READING,
    Word.CORRECTED,
    Word.UNTESTED,
    Word.UNTESTABLE,
    Word.ANSWERED,
    Word.HOLDS,
)
"""Order of the table's rows."""

VERDICTS = html.Table("Claim | What the paper states, in our words | Verdict | What is true instead")
EVIDENCE = "appendix-claims.html"


def facts(_: Run) -> dict:
    """Return how many are decided, how, and how many by a criterion that is not the first; and a row a claim."""
    every = claims.judge_all()
    changed = [one for one in every if one.claim.earlier]
    return {
        "decided": len(every),
        "words": claims.told(one.word for one in every),
        "first_words": claims.told(one.first for one in every),
        "changed": len(changed),
        "turned": sum(one.word != one.first for one in changed),
        "verdicts": table(every),
    }


def table(every: list[Verdict]) -> html.Markdown | None:
    """Return a row a claim, refuted ones first: number and section, statement, verdicts, and what is true."""
    rows = (
        (
            f'<a href="{EVIDENCE}#{one.id.lower()}">{one.claim.id}</a>',
            prose(one.claim.sentence),
            f"{html.badge(str(one.word))}{'' if one.first == one.word else f'<br>first: {one.first}'}",
            prose(one.correction) if one.correction else "",
        )
        for one in sorted(every, key=lambda one: ORDER.index(one.word))
    )
    return VERDICTS(rows)
