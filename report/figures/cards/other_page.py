"""Pages of what is exported and is no regulator: laws with a state, impedances, springs."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

from bench.base.provenance import ROOT
from bench.export.subject import COMPENSATOR, IMPEDANCE, SPRING, subject_words
from bench.law.contenders.registry import contenders
from report.figures.cards import regulators
from report.figures.cards.law_page import BACK, LawPage, in_every_language, taken
from report.figures.kit import html
from report.figures.kit.families import PAGES
from report.figures.kit.page import Run
from report.figures.kit.tables import Table

OTHERS = Table("Law | Is | Proved | On the command line")


class Kind(NamedTuple):
    """A kind of laws: what its words begin with, its folder of contenders, what it is, and its files' records."""

    prefix: str
    folder: str
    title: str
    known: dict


KINDS = (
    Kind(COMPENSATOR, "compensators", "a law with a state", contenders("compensators")),
    Kind(IMPEDANCE, "impedances", "an impedance", contenders("impedances")),
    Kind(SPRING, "springs", "a spring of a pose or of a rotation", contenders("springs")),
)


class Other(NamedTuple):
    """A law of another kind: its kind, its file's record, and the word by which it is exported."""

    kind: Kind
    record: Any
    word: str

    @property
    def name(self) -> str:
        """Return the name of its page."""
        return f"{self.kind.prefix}{self.record.name}"

    @property
    def where(self) -> str:
        """Its file, from the root."""
        return f"bench/law/contenders/{self.kind.folder}/{self.record.name.replace('-', '_')}.py"

    @property
    def file(self) -> Path:
        """Return the path of its file on this machine."""
        return ROOT / self.where


def every_other() -> list[Other]:
    """Each once; of an impedance in coordinates, by its first ones."""
    words: dict[str, str] = {}
    for word in subject_words():
        words.setdefault(word.partition("/")[0], word)
    return [
        Other(kind, record, words[f"{kind.prefix}{record.name}"]) for kind in KINDS for record in kind.known.values()
    ]


def page(one: Other) -> LawPage:
    """What it is, where it fails, what is proved, and its files."""
    files = in_every_language(one.word)
    what, fails = regulators.docstring(one.file)
    said = {"Is": f"{one.kind.title[:1].upper()}{one.kind.title[1:]}.", "Limitations": fails, "Proved": proved(one)}
    lines = [f"<p>{html.foreign(text)}</p>" for text in what]
    lines += [f'<p class="card-fact"><b>{head}.</b> {html.foreign(text)}</p>' for head, text in said.items() if text]
    body = (
        f"<section>{BACK}<h1>{html.foreign(one.record.title)}</h1>"
        f'<section class="law-card alone" style="--law: var(--rule)"><header><span class="card-source">'
        f"{html.foreign(one.record.source)}</span></header>"
        f'<div class="card-formula">{html.formula(one.record.formula)}</div>'
        f'<div class="card-body"><div class="card-text">{"".join(lines)}</div></div></section>'
        f"{taken(one.word, files)}{regulators.folded(one.file, one.where)}</section>"
    )
    return LawPage(one.name, one.record.title, body, dict(files.values()))


def proved(one: Other) -> str:
    """What is proved of it; nothing of impedances and springs."""
    found = getattr(one.record, "property", "")
    return regulators.PROPERTIES.get(found, f"{found[:1].upper()}{found[1:]}." if found else "")


def tables(_: Run) -> dict:
    """Every such law as a line."""
    return {"other_laws": OTHERS(map(line, every_other()))}


def link(one: Other) -> html.Html:
    """Its title, leading to its page."""
    return html.Html(f'<a href="{PAGES}/{one.name}.html">{html.foreign(one.record.title)}</a>')


def line(one: Other) -> tuple:
    """A link to its page, its kind, what is proved, its word on the command line."""
    return link(one), one.kind.title, html.foreign(getattr(one.record, "property", "")) or html.MISSING, f"`{one.word}`"
