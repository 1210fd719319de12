"""The page of a law of any kind: a card of fields, its files for other languages, and its source."""

from __future__ import annotations

import ast
import html as markup
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import PythonLexer

from bench.export.language import find_language, language_words
from bench.export.subject import find_subject
from report.figures.kit import html
from report.figures.kit.spelling import typeset

CATALOGUE = Path(__file__).resolve().parents[2] / "pages" / "appendix-laws.md"
BACK = '<p class="hint"><a href="../pages/appendix-laws.html">Catalogue of laws</a></p>' if CATALOGUE.is_file() else ""
PROPERTIES = {
    "local": "Stable near the goal, by linearization.",
    "almost global": "Stable from all starts but a set of measure zero. No continuous law without memory can do more "
    "(Bhat & Bernstein 2000).",
    "global with memory": "Stable from every start, with memory. No continuous law is without (Bhat & Bernstein 2000).",
    "none": "Nothing.",
    "": "",
}
LIMITATIONS = re.compile(r"\bLimitations:\s*(.*)", re.DOTALL)


class LawPage(NamedTuple):
    """name: of the page, without a suffix. files: what it offers to take away, by name."""

    name: str
    title: str
    body: str
    files: dict[str, str]


class Source(NamedTuple):
    """A contender's file on this machine, and its path as a reader sees it."""

    file: Path
    where: str


def make_page(name: str, title: str, card: str, source: Source, word: str = "", live: str = "") -> LawPage:
    """Return the page of a law.

    Args:
        word: by which it is exported; empty if it is not. live: the page on which it runs, from the site's root.
    """
    subject = find_subject(word) if word else None
    languages = map(find_language, language_words() if word else ())
    files = {each.title: each.law(subject) for each in languages if subject}
    take = take_files(word, files, live) if files else ""
    body = f"<section>{BACK}<h1>{html.foreign(title)}</h1>{card}{take}{fold(source)}</section>"
    return LawPage(name, title, body, dict(files.values()))


def make_card(record: Any, title: str, said: tuple[list[str], Mapping[str, str]], look: str, costs: str = "") -> str:
    """Return the card of a law.

    Args:
        record: its source and formula. said: paragraphs, and fields by their heads. look: its colour as CSS.
    """
    formula = f'<div class="card-formula">{html.formula(record.formula)}</div>' if record.formula else ""
    lines = [f"<p>{html.foreign(text)}</p>" for text in said[0]]
    lines += [f'<p class="card-fact"><b>{head}.</b> {html.foreign(text)}</p>' for head, text in said[1].items() if text]
    return (
        f'<section class="law-card" style="--law: {look}"'
        f' aria-label="{markup.escape(title, quote=True)}">'
        f'<header><span class="card-source">{html.foreign(record.source)}</span></header>{formula}'
        f'<div class="card-body"><div class="card-text">{"".join(lines)}{costs}</div></div></section>'
    )


def say_property(name: str) -> str:
    """Return what is proved of a law, in a sentence."""
    return PROPERTIES.get(name, f"{name[:1].upper()}{name[1:]}.")


def docstring(file: Path) -> tuple[list[str], str]:
    """Return a contender's file in words: paragraphs on what it is, and where it fails."""
    text = ast.get_docstring(ast.parse(file.read_bytes())) or ""
    found = LIMITATIONS.search(text)
    fails = typeset(" ".join(found[1].split())) if found else ""
    about = text[: found.start()] if found else text
    paragraphs = [typeset(" ".join(one.split())) for one in about.split("\n\n") if one.strip()]
    return paragraphs, fails[:1].upper() + fails[1:]


def fold(source: Source) -> str:
    """Return a file's text behind its name."""
    text = source.file.read_text(encoding="utf-8", errors="replace")
    return (
        f'<details class="law-source"><summary>Its file, <code>{markup.escape(source.where)}</code></summary>'
        f'<div class="highlight"><pre tabindex="0">{highlight(text, PythonLexer(), HtmlFormatter(nowrap=True))}</pre>'
        "</div></details>"
    )


def take_files(word: str, files: dict[str, tuple[str, str]], live: str) -> str:
    """Return what leads to its files and to the page on which it runs."""
    links = ", ".join(f'<a href="code/{name}" download>{title}</a>' for title, (name, _) in files.items())
    tried = f'<a href="../{live}.html#a={word}">Try it</a>, or take it' if live else "Take it"
    return f"<p>{tried}: {links}. <code>bench export {word} --to c</code> adds test vectors and a test.</p>"
