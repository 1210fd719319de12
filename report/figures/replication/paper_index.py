"""From a part of the paper to its chapter, its claims, the tables of rows, and the command that makes the rows."""

import functools
import re
import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from bench.experiments.tables.run import Run
from bench.findings.amounts import join_words
from bench.findings.claims import all_claims, judge_possible
from bench.findings.claims.errata import COVERAGE, Item
from bench.findings.claims.verdict import Verdict
from report.figures.kit import html
from report.figures.kit.spelling import marked_up, prose
from report.figures.replication.conclusions import EVIDENCE, link_claims
from report.subjects import find_pages

ITEMS = html.PageTable(
    "Part of the paper | What this part says | Chapter of this book | Claims | Where the evidence "
    "is | Command"
)

COMPUTED = "experiment"
"""Word for evidence that a claim computes itself."""

PAGE = re.compile(r"(\d\d)-")


@functools.cache
def read_commands() -> dict[str, str]:
    """Return the command that makes the rows of each part of the paper."""
    return tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))


def facts(run: Run) -> dict[str, Any]:
    """Return a row for each equation and figure, and every sentence by section."""
    decided, _ = judge_possible(run)
    verdicts = {verdict.id: verdict for verdict in decided}
    rows = [describe_item(item, verdicts) for item in COVERAGE]
    return {"items": ITEMS(rows), "sentences": html.Html(list_sentences())}


def describe_item(item: Item, verdicts: Mapping[str, Verdict]) -> tuple:
    """Return a row: the part of the paper, and where it leads."""
    claims = [claim for claim in item.claims if claim.startswith("C")]
    errata = [claim for claim in item.claims if claim not in claims]
    links = [link for link in (link_claims(claims), *map(link_erratum, errata)) if link]
    tables = list_tables(verdicts[claim] for claim in claims if claim in verdicts)
    command = read_commands()[item.paper]
    shown = f"`{command}`" if command else html.MISSING
    pages = ", ".join(map(link_page, find_pages(item.subjects)))
    shown_links, shown_tables = ", ".join(links) or html.MISSING, tables or html.MISSING
    return prose(name_part(item.paper)), prose(item.says), pages, shown_links, shown_tables, shown


def name_part(paper: str) -> str:
    """Return a part of the paper as a reader calls it: '(2.1)', 'Section 3.3: compliance'."""
    if not paper[0].isdigit():
        return paper
    places, _, subject = paper.rpartition(", ")
    return f"Section{'s' * (' ' in places)} {places}: {subject}"


def list_tables(verdicts: Iterable[Verdict]) -> str:
    """Return the tables that hold the evidence of some claims, and whether a command calculates some of it."""
    names = {name for verdict in verdicts for name in verdict.evidence.tables}
    links = [f"[{name}](appendix-data.md)" for name in sorted(names - {COMPUTED})]
    stored = [f"result table{'s' * (len(links) > 1)} {join_words(links)}"] if links else []
    part = "a part is " * bool(links)
    calculated = [f"{part}calculated by `bench claims`"] if COMPUTED in names else []
    return "; ".join([*stored, *calculated])


def link_page(name: str) -> str:
    """Return a link to a page: chapters by number, the rest of the book by name."""
    number = PAGE.match(name)
    text = f"chapter {int(number[1])}" if number else name.replace("-", " ")
    return f"[{text}]({name}.md)"


def link_erratum(name: str) -> str:
    """Return an erratum with a link to the list of them."""
    return f'<a href="{EVIDENCE}#errata">{name}</a>'


def list_sentences() -> str:
    """Return every sentence of the paper that is judged, by section, folded; each leads to its evidence."""
    sections: dict[str, list[str]] = {}
    for claim in sorted(all_claims(), key=lambda claim: claim.section):
        link = f'<a href="{EVIDENCE}#{claim.id.lower()}">{claim.id}</a>'
        first_section = re.split(r"[, ]", claim.section)[0]
        sections.setdefault(first_section, []).append(f"<li>{link} {marked_up(claim.sentence)}</li>")
    titles = {name: f"Section {name}" if name[0].isdigit() else name.capitalize() for name in sections}
    lists = "".join(f"<h2>{titles[name]}</h2><ul>{''.join(items)}</ul>" for name, items in sections.items())
    return (
        '<details class="paper-sentences">'
        f"<summary>All {len(all_claims())} claims of the paper in our words, by "
        f"section of the paper</summary>{lists}</details>"
    )
