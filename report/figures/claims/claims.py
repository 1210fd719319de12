"""The verdicts on a page: tiles, the table, and a claim's section. All words are the claim's own."""

from __future__ import annotations

import html as escape
from collections.abc import Iterable

from bench.base.files import read_json
from bench.findings import claims
from bench.findings.claims import Verdict, Word, steadiness, tally
from bench.findings.claims.errata import COVERAGE, ERRATA, UNTESTABLE, Erratum, Item
from bench.findings.claims.verdict import MISPRINTS, does
from report.figures.kit import html
from report.figures.kit.page import Run
from report.figures.kit.spelling import marked_up, prose, typeset
from report.figures.kit.tables import Table

ORDER = (Word.FAILS, Word.DEPENDS, Word.CORRECTED, Word.UNTESTABLE, Word.ANSWERED, Word.HOLDS)
"""Order of the table's rows."""

VERDICTS = Table("Claim | Section | The paper | Verdict | Criterion revised? | What is true")
SENTENCES = Table("Section | The paper | Why it is not tested")
PARTS = Table("The paper | What it says | Claims and errata | Pages")
SLIPS = Table(" | Where | Printed | Should be | Checked")


def facts(_: Run) -> dict:
    """How many are decided, by what rule, and how many by a criterion that is not the first."""
    every = claims.judge_all()
    changed = [one for one in every if one.claim.earlier]
    return {
        "rule": typeset(claims.RULE),
        "decided": len(every),
        "words": claims.told(one.word for one in every),
        "first_words": claims.told(one.first for one in every),
        "changed": len(changed),
        "turned": sum(one.word != one.first for one in changed),
        "n_computed": sum(one.check is not None for one in ERRATA),
        "n_read": sum(one.check is None for one in ERRATA),
        "misprints": typeset(" ".join(MISPRINTS.split())),
        "steady": steadiness.describe(read_json(steadiness.STORED), {one.id: str(one.word) for one in every}),
    }


def tables(_: Run) -> dict:
    """Every claim in a row, and what decided each, folded."""
    every = claims.judge_all()
    sentences = SENTENCES((one.section, f"“{prose(one.quote)}”", prose(one.why)) for one in UNTESTABLE)
    slips = SLIPS(map(describe_slip, sorted(ERRATA, key=lambda one: one.check is None)))
    return {
        "verdicts": table(every),
        "sections": html.Html("".join(map(section, every))),
        "untestable": sentences,
        "slips": slips,
        "coverage": PARTS(map(describe_item, COVERAGE)),
    }


def describe_item(one: Item) -> tuple:
    """Return a row of the table of what the book does with each part of the paper."""
    ids = ", ".join(f'<a href="#{id.lower()}">{id}</a>' if id.startswith("C") else id for id in one.claims)
    pages = ", ".join(f"[{page.partition('-')[2].replace('-', ' ')}]({page}.md)" for page in one.pages)
    return prose(one.paper), prose(one.says), ids, pages


def checked(one: Erratum) -> str:
    """Return how it was checked, the computed ones just now.

    Errors:
        ValueError: the check no longer confirms its erratum, and the page must not say that it does.
    """
    if one.check and not one.check():
        raise ValueError(f"erratum {one.id}: its check '{one.how}' does not confirm it (cure: mend it in errata.py)")
    return f"{'computed: ' if one.check else ''}{prose(one.how)}"


def describe_slip(one: Erratum) -> tuple:
    """Return a row of the table."""
    return one.id, prose(one.where), f"“{prose(one.printed)}”", prose(one.right), checked(one)


def tiles(every: list[Verdict]) -> html.Html:
    """How many statements were decided, and how many got each word: by the present criteria and by the first ones."""
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


def table(every: list[Verdict], page: str = "") -> html.Markdown | None:
    """Return a row a claim, refuted ones first: sentence with value, verdict, history, and what is true.

    page: where the sections are; empty on their own page.
    """
    return VERDICTS(
        (
            f'<a href="{page}#{anchor(one)}">{one.claim.id}</a>',
            one.claim.section,
            prose(quoted(one)),
            html.badge(str(one.word)),
            revised(one),
            prose(one.correction) if one.correction else "",
        )
        for one in sorted(every, key=lambda one: ORDER.index(one.word))
    )


def revised(one: Verdict) -> str:
    """Whether the criterion is not the first one, and the first one's word if that is another."""
    if not one.claim.earlier:
        return "no"
    return "yes" if one.first == one.word else f"yes; first: {one.first}"


def quoted(one: Verdict) -> str:
    """Return the paper's sentence, with its value if it gives one."""
    claim = one.claim
    value = "" if claim.value == "none given" else f" (Its value: {claim.value}.)"
    return f"“{claim.quote}”{value}" if claim.quote else claim.sentence


def anchor(one: Verdict) -> str:
    """Return what a claim's section is called in links."""
    return one.claim.id.lower()


def section(one: Verdict) -> str:
    """Return what decided a claim, folded under its sentence; a link to it opens it, for the anchor is inside."""
    claim = one.claim
    rows = {
        "Evidence": marked_up(str(one.evidence)),
        "Criterion": marked_up(f"{claim.criterion} ({written(claim.written)})" if claim.written else claim.criterion),
        "Before": _listed(f"{written(old.written)}: {old.criterion} By it: {old.word}." for old in claim.earlier),
        "Left open": marked_up(claim.open),
        "Readings": _listed(claim.readings),
        "Rows": f"{html.number(one.evidence.rows)} from {escape.escape(', '.join(one.evidence.tables))}; "
        f"the paper's {escape.escape(claim.place)}",
    }
    entries = "".join(f"<dt>{name}</dt><dd>{text}</dd>" for name, text in rows.items() if text)
    head = f"<b>{claim.id}</b> <span>{marked_up(claim.sentence)}</span> {html.badge(str(one.word))}"
    return (
        f'<details class="claim-fold"><summary>{head}</summary><dl class="claim" id="{anchor(one)}">{entries}</dl>'
        "</details>"
    )


def written(when: str) -> str:
    """'2026-11-21 9072535' for a reader."""
    date, _, commit = when.partition(" ")
    return f"written {date}, commit {commit}"


def _listed(texts: Iterable[str]) -> str:
    items = "".join(f"<li>{marked_up(text)}</li>" for text in texts)
    return f"<ul>{items}</ul>" if items else ""
