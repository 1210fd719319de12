"""Pages of what is exported and is no regulator: laws with a state, impedances, springs."""

from __future__ import annotations

from typing import Any, NamedTuple

from bench.base.provenance import ROOT
from bench.export.subject import COMPENSATOR, IMPEDANCE, SPRING, subject_words
from bench.law.contenders.registry import contenders
from report.figures.cards.card import LawPage, Source, docstring, make_card, make_page, say_property
from report.figures.kit import html
from report.figures.kit.families import PAGES
from report.figures.kit.page import Run
from report.figures.kit.tables import Table

OTHERS = Table("Law | Is | Proved | On the command line")
KINDS = {
    COMPENSATOR: ("compensators", "a law with a state"),
    IMPEDANCE: ("impedances", "an impedance"),
    SPRING: ("springs", "a spring of a pose or of a rotation"),
}
"""What the words of a kind begin with -> its folder of contenders, and what it is."""


class Other(NamedTuple):
    """A law of another kind: its file's record, the word by which it is exported, its page's name, folder and kind."""

    record: Any
    word: str
    name: str
    folder: str
    kind: str

    @property
    def source(self) -> Source:
        """Return its file."""
        where = f"bench/law/contenders/{self.folder}/{self.record.name.replace('-', '_')}.py"
        return Source(ROOT / where, where)


def every_other() -> list[Other]:
    """Each once; of an impedance in coordinates, by its first ones."""
    words: dict[str, str] = {}
    for word in subject_words():
        words.setdefault(word.partition("/")[0], word)
    return [
        Other(record, words[f"{prefix}{record.name}"], f"{prefix}{record.name}", folder, kind)
        for prefix, (folder, kind) in KINDS.items()
        for record in contenders(folder).values()
    ]


def page(one: Other) -> LawPage:
    """Return the page: what it is, where it fails, what is proved, and its files."""
    what, fails = docstring(one.source.file)
    fields = {"Is": f"{one.kind[:1].upper()}{one.kind[1:]}.", "Limitations": fails, "Proved": say_property(proved(one))}
    card = make_card(one.record, one.record.title, (what, fields), "var(--rule)")
    return make_page(one.name, one.record.title, card, one.source, one.word)


def proved(one: Other) -> str:
    """Return the property that is proved of it; none of impedances and springs."""
    return getattr(one.record, "property", "")


def tables(_: Run) -> dict:
    """Every such law as a line."""
    return {"other_laws": OTHERS(map(line, every_other()))}


def line(one: Other) -> tuple:
    """Return a link to its page, its kind, what is proved, its word on the command line."""
    link = html.Html(f'<a href="{PAGES}/{one.name}.html">{html.foreign(one.record.title)}</a>')
    return link, one.kind, html.foreign(proved(one)) or html.MISSING, f"`{one.word}`"
