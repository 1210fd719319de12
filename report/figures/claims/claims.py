"""The verdicts on a page: tiles and a strip, the table, and a claim's section. All words are the claim's own."""

from __future__ import annotations

import html as escape
from collections import Counter
from collections.abc import Iterable

from bench.findings import claims
from bench.findings.claims import Verdict
from bench.studies import verdicts
from bench.tables.files import read_json
from report.figures.kit import html
from report.figures.kit.page import Run
from report.figures.kit.spelling import marked_up, prose, typeset
from report.figures.kit.tables import Table

LABELS = {
    "holds": "hold",
    "holds with a correction": "hold with a correction",
    "does not hold": "do not hold",
    "open in 1988; answered since": "was open in 1988 and is answered since",
    "not testable": "cannot be tested",
}
"""Verdicts in their order -> what statements do that got them."""

VERDICTS = Table("Claim | Section | The paper | Verdict | Correction of the paper")


def facts(_: Run) -> dict:
    """How many are decided, by what rule, and how many by a criterion that is not the first."""
    every = claims.judge_all()
    changed = [one for one in every if one.earlier]
    return {
        "rule": typeset(claims.RULE),
        "decided": len(every),
        "words": ", ".join(f"{number} {label}" for _, number, label in counted(every)),
        "changed": len(changed),
        "turned": sum(one.word != one.earlier[-1][1] for one in changed),
        "steady": steady(read_json(verdicts.STORED)),
    }


def steady(study: dict) -> str:
    """What the study of seeds and of half the step found, in a sentence."""
    runs = study["runs"]
    seeds = sum(name != verdicts.HALF_STEP for name in runs)
    other = verdicts.turned(runs, study["reference"])
    found = "no claim gets another word" if not other else f"{', '.join(other)} get another word somewhere"
    return (
        f"On {seeds} other seeds of the starts{' and at half the step' if verdicts.HALF_STEP in runs else ''} {found}"
    )


def tables(_: Run) -> dict:
    """Every claim in a row, and what decided each, folded."""
    every = claims.judge_all()
    return {"verdicts": table(every), "sections": html.Html("".join(map(section, every)))}


def counted(every: list[Verdict]) -> list[tuple[str, int, str]]:
    """Of each word that some claim got: the word, how many, and what they do."""
    counts = Counter(str(one.word) for one in every)
    return [(word, counts[word], label) for word, label in LABELS.items() if counts[word]]


def tiles(every: list[Verdict]) -> html.Html:
    """How many statements were decided, and how many got each word."""
    entries = [("plain", len(every), "statements of the paper decided")]
    entries += [(html.VERDICTS[word], number, label) for word, number, label in counted(every)]
    tile = '<div class="tile {}"><b>{}</b><span>{}</span></div>'
    return html.Html(f'<div class="tiles">{"".join(tile.format(*entry) for entry in entries)}</div>')


def strip(every: list[Verdict], page: str) -> html.Html:
    """A square a claim in the colour of its word, leading to its section of the page."""
    square = '<a class="{}" href="{}#{}" title="{}"><span>{}</span></a>'
    squares = (
        square.format(
            html.VERDICTS[one.word],
            page,
            anchor(one),
            escape.escape(f"{one.claim.sentence} {one.word.capitalize()}."),
            one.claim.id,
        )
        for one in every
    )
    return html.Html(f'<div class="strip">{"".join(squares)}</div>')


def table(every: list[Verdict], page: str = "") -> html.Markdown | None:
    """A row a claim: where it stands, the sentence with its value, the verdict, and what it corrects.

    page: where the sections are; empty on their own page.
    """
    return VERDICTS(
        (
            f'<a href="{page}#{anchor(one)}">{one.claim.id}</a>',
            one.claim.section,
            prose(quoted(one)),
            html.badge(str(one.word)),
            prose(one.correction) if one.correction else "",
        )
        for one in every
    )


def quoted(one: Verdict) -> str:
    """The paper's sentence, with its value if it gives one."""
    claim = one.claim
    value = "" if claim.value == "none given" else f" (Its value: {claim.value}.)"
    return f"“{claim.quote}”{value}" if claim.quote else claim.sentence


def anchor(one: Verdict) -> str:
    """What a claim's section is called in links."""
    return one.claim.id.lower()


def section(one: Verdict) -> str:
    """What decided a claim, folded under its sentence; a link to it opens it, for the anchor is inside."""
    claim = one.claim
    rows = {
        "Evidence": marked_up(str(one.evidence)),
        "Criterion": marked_up(f"{claim.criterion} ({written(claim.written)})" if claim.written else claim.criterion),
        "Before": _listed(f"{written(old.written)}: {old.criterion} By it: {word}." for old, word in one.earlier),
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
