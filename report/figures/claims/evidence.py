"""What decided each claim, sentences that no run decides, what the book does with the paper's parts, and errata."""

import html as escape
from collections.abc import Iterable

from bench.base.files import read_json
from bench.findings import claims
from bench.findings.claims import Verdict, at_gains
from bench.findings.claims.errata import COVERAGE, ERRATA, UNTESTABLE, Erratum, Item
from bench.findings.claims.verdict import MISPRINTS
from report.figures.kit import html
from report.figures.kit.page import Run
from report.figures.kit.spelling import marked_up, prose, typeset

SENTENCES = html.Table("Section | The paper | Why it is not tested")
PARTS = html.Table("The paper | What it says | Claims and errata | Pages")
SLIPS = html.Table("Slip | Where | Printed | Should be | Checked")


def facts(_: Run) -> dict:
    """Return the rules of all criteria, how steady verdicts are, what decided each claim, and the tables."""
    every = claims.judge_all()
    return {
        "rule": typeset(claims.RULE),
        "n_computed": sum(one.check is not None for one in ERRATA),
        "n_read": sum(one.check is None for one in ERRATA),
        "misprints": typeset(" ".join(MISPRINTS.split())),
        "steady": at_gains.describe(read_json(at_gains.STORED), {one.id: str(one.word) for one in every}),
        "sections": html.Html("".join(map(section, every))),
        "untestable": SENTENCES((one["section"], f"“{prose(one['quote'])}”", prose(one["why"])) for one in UNTESTABLE),
        "slips": SLIPS(map(describe_slip, sorted(ERRATA, key=lambda one: one.check is None))),
        "coverage": PARTS(map(describe_item, COVERAGE)),
    }


def describe_item(one: Item) -> tuple:
    """Return a row of the table of what the book does with each part of the paper."""
    ids = ", ".join(f'<a href="#{id.lower()}">{id}</a>' if id.startswith("C") else id for id in one.claims)
    pages = ", ".join(f"[{page.partition('-')[2].replace('-', ' ')}]({page}.md)" for page in one.pages)
    return prose(one.paper), prose(one.says), ids, pages


def describe_slip(one: Erratum) -> tuple:
    """Return the row of a slip, with how it was checked just now; ValueError if the check no longer confirms it."""
    if one.check and not one.check():
        raise ValueError(f"erratum {one.id}: its check '{one.how}' does not confirm it (cure: mend it in errata.py)")
    checked = f"{'computed: ' if one.check else ''}{prose(one.how)}"
    return one.id, prose(one.where), f"“{prose(one.printed)}”", prose(one.right), checked


def section(one: Verdict) -> str:
    """Return what decided a claim, folded under its sentence; a link to it opens it, for the anchor is inside."""
    claim = one.claim
    value = "" if claim.value == "none given" else f" (Its value: {claim.value}.)"
    quoted = f"“{claim.quote}”{value}" if claim.quote else claim.sentence
    rows = {
        "The paper": f"{escape.escape(claim.section)}: {marked_up(quoted)}",
        "What is true": marked_up(one.correction or ""),
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
        f'<details class="claim-fold"><summary>{head}</summary><dl class="claim" id="{one.id.lower()}">{entries}</dl>'
        "</details>"
    )


def written(when: str) -> str:
    """Return '2026-11-21 9072535' in words."""
    date, _, commit = when.partition(" ")
    return f"written {date}, commit {commit}"


def _listed(texts: Iterable[str]) -> str:
    items = "".join(f"<li>{marked_up(text)}</li>" for text in texts)
    return f"<ul>{items}</ul>" if items else ""
