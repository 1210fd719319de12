"""A law's own page: formula, words, where it fails, costs, map, its files for other languages, and its source."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from bench.export.language import find_language, language_words
from bench.export.subject import find_subject
from bench.law.contender import Contender
from report.figures.cards import regulators
from report.figures.kit import html, laws
from report.figures.kit.families import anchor
from report.figures.kit.page import Run

CATALOGUE = Path(__file__).resolve().parents[2] / "pages" / "03-regulators.md"
BACK = '<p class="hint"><a href="../pages/03-regulators.html">Catalogue of laws</a></p>' if CATALOGUE.is_file() else ""


class LawPage(NamedTuple):
    """name: of the page, without a suffix. files: what it offers to take away, by name."""

    name: str
    title: str
    body: str
    files: dict[str, str]


def every_law() -> list[Contender]:
    """Each in each of its coordinates, the run's own among them."""
    return [one for regulator in regulators.in_order() for one in regulators.papers_first(regulator)]


def page(one: Contender, run: Run, live: str = "") -> LawPage:
    """The page of a law.

    Args:
        live: the page on which laws run, from the site's root; empty where the site has none.
    """
    title, files = laws.title_of(one), exported(one)
    body = (
        f"<section>{BACK}<h1>{html.foreign(title)}</h1>{regulators.card(one, run)}"
        f"{taken(one.on_free_body, files, live)}{regulators.source(one.regulator)}</section>"
    )
    return LawPage(anchor(one.on_free_body), title, body, dict(files.values()))


def exported(one: Contender) -> dict[str, tuple[str, str]]:
    """Return by the language's title the first file of its export: name and text; none of a user's own law."""
    if one.regulator.origin or one.regulator.costing_only:
        return {}
    return in_every_language(one.on_free_body)


def in_every_language(word: str) -> dict[str, tuple[str, str]]:
    """Return by the language's title the first file of the export of a word: name and text."""
    subject = find_subject(word)
    return {each.title: each.law(subject) for each in map(find_language, language_words())}


def taken(word: str, files: dict[str, tuple[str, str]], live: str = "") -> str:
    """What leads to its files and to the page on which it runs."""
    if not files:
        return ""
    links = ", ".join(f'<a href="code/{name}" download>{title}</a>' for title, (name, _) in files.items())
    tried = f'<a href="../{live}.html#a={word}">Try it</a>, or take it' if live else "Take it"
    return f"<p>{tried}: {links}. <code>python -m bench export {word} --to c</code> adds test vectors and a test.</p>"
