"""The laws in families of one panel each, drawn in their own colours over all others in grey, with short names."""

from collections.abc import Iterable
from typing import NamedTuple

from bench.law.contenders.registry import PAPERS_LAWS, all_contenders
from bench.law.kinds import CONTROL
from report.figures.kit import html, laws

PAGES = "../laws"
"""Folder of the pages of laws, from a page of the book."""

OTHERS = "Others"
"""The family of a law that none names: a user's own, or a new one."""


class Family(NamedTuple):
    """A title, and its laws: contender -> what it is called beside a curve."""

    title: str
    laws: dict[str, str]


FIRST = (
    "The paper's three",
    "On the matrix",
    "On the quaternion",
    "On three parameters",
    "With memory",
    "With the bound of the motor",
    "Feedback-linearized elsewhere",
    "Euler variants, controls",
)
"""Titles in the order of the figures; what else a law calls its family comes after them."""

CONTROLS = tuple(one.name for one in all_contenders() if one.regulator.role == CONTROL)
"""Negative controls: laws that are here because they must fail."""


def present(names: Iterable[str]) -> list[Family]:
    """Return the families of these laws, the paper's first in their order, then the others, controls last."""
    found: dict[str, dict[str, str]] = {title: {} for title in FIRST}
    others = {}
    for name in sorted(set(names), key=_place):
        one = laws.contender(name)
        if one and one.family:
            found.setdefault(one.family, {})[name] = one.short
        else:
            others[name] = name
    return [Family(title, own) for title, own in (*found.items(), (OTHERS, others)) if own]


def _place(name: str) -> tuple:
    regulator = laws.regulator(laws.regulator_of(name))
    if regulator is None:
        return 0, False, name
    rank = PAPERS_LAWS.index(regulator.name) + 1 if regulator.name in PAPERS_LAWS else 0
    return rank, regulator.role == CONTROL, name


def in_order(names: Iterable[str]) -> list[str]:
    """Return the names, family by family."""
    return [name for one in present(names) for name in one.laws]


def word(name: str) -> str:
    """Return what a law is called where its family is not said too."""
    one = laws.contender(name)
    short = present([name])[0].laws[name]
    return f"{one.regulator.display.short} {short}" if one and short.startswith("in ") else short


def anchor(name: str) -> str:
    """Return what a law's page is called."""
    return name.replace("/", "-")


def link(name: str, text: str) -> html.Html:
    """Return a law by this text, leading to its page."""
    return html.Html(f'<a href="{PAGES}/{anchor(name)}.html">{html.law(name, text)}</a>')
