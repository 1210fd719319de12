"""The verdicts on a page: tiles and a strip, the table, and a claim's section. All words are the claim's own."""

from __future__ import annotations

import html as escape
from collections import Counter
from collections.abc import Iterable

from bench.findings import claims
from bench.findings.claims import Verdict, Word
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
    "depends on the gains": "depends on the gains",
    "not testable": "cannot be tested",
}
"""Verdicts in their order -> what statements do that got them."""

ORDER = (Word.FAILS, Word.DEPENDS, Word.CORRECTED, Word.ANSWERED, Word.UNTESTABLE, Word.HOLDS)
"""Verdicts as the table has them, refuted ones first."""

VERDICTS = Table("Claim | Section | The paper | Verdict | What is true instead | Criterion revised; first verdict")


def facts(_: Run) -> dict:
    """Return how many are decided, by what rule, by present and by first criteria, and where gains change a word."""
    every = claims.judge_all()
    return {
        "rule": typeset(claims.RULE),
        "decided": len(every),
        "words": said(one.word for one in every),
        **revised(every),
        "by_gains": by_gains(every),
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


def revised(every: list[Verdict]) -> dict:
    """Return the tally by the criteria first written, how many were revised, and how many verdicts that changed."""
    return {
        "first": said(one.first for one in every),
        "changed": sum(one.is_revised for one in every),
        "turned": sum(one.word != one.first for one in every),
    }


def by_gains(every: list[Verdict]) -> str:
    """Return which verdicts are others in the runs at other damping ratios."""
    words = {one.id: str(one.word) for one in every}
    found = []
    for zeta, own in read_json(verdicts.AT_GAINS)["words"].items():
        other = [f"{id} ({word})" for id, word in own.items() if word != words.get(id)]
        found.append(f"at a damping ratio of {zeta}: {', '.join(other) or 'none'}")
    return "; ".join(found)


def tables(_: Run) -> dict:
    """Every claim in a row, and what decided each, folded."""
    every = claims.judge_all()
    return {"verdicts": table(every), "sections": html.Html("".join(map(section, every)))}


def said(words: Iterable[str]) -> str:
    """Return '18 hold, 13 hold with a correction, ...'."""
    return ", ".join(f"{number} {label}" for _, number, label in counted(words))


def counted(words: Iterable[str]) -> list[tuple[str, int, str]]:
    """Return each word that some claim got, how many, and what they do."""
    counts = Counter(map(str, words))
    return [(word, counts[word], label) for word, label in LABELS.items() if counts[word]]


def tiles(every: list[Verdict]) -> html.Html:
    """Return how many statements were decided, how many got each word, and the tally by the first criteria."""
    entries = [("plain", len(every), "statements of the paper decided")]
    entries += [(html.VERDICTS[word], number, label) for word, number, label in counted(one.word for one in every)]
    tile = '<div class="tile {}"><b>{}</b><span>{}</span></div>'
    before = (
        "<p>By the criteria first written: {first}. {changed} of {decided} criteria were revised after the first "
        "results; this changed {turned} verdicts.</p>"
    ).format(decided=len(every), **revised(every))
    return html.Html(f'<div class="tiles">{"".join(tile.format(*entry) for entry in entries)}</div>{before}')


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
            str(one.first) if one.is_revised else "",
        )
        for one in sorted(every, key=lambda one: (ORDER.index(one.word), one.id))
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
