"""Places in the book that show a claim: figures, tables, sections and pages, as Markdown and as HTML."""

import functools
import re
import tomllib
from pathlib import Path
from typing import NamedTuple

from report.figures.kit.page import REPORT

LABEL = re.compile(r"^(?::name: ([\w-]+)|\(([\w-]+)\)=)$", re.MULTILINE)
TITLE = re.compile(r"^# (.+)$", re.MULTILINE)
CHAPTER = re.compile(r"(\d\d)-")
KINDS = {"fig": "figure", "tab": "table"}


class BookPlace(NamedTuple):
    """A figure, a table or a section of a page, or a page.

    label: empty of a whole page. page: the file's name without its ending. title: the page's.
    """

    label: str
    page: str
    title: str

    @property
    def kind(self) -> str:
        """Return 'figure', 'table', 'section', or nothing of a whole page."""
        return KINDS.get(self.label.partition("-")[0], "section") if self.label else ""

    @property
    def markdown(self) -> str:
        """Return a link for a table: the number of a figure or a table, else the name of the page."""
        if self.kind in KINDS.values():
            return f"{{numref}}`{self.label}`"
        return f"[{self.short}]({f'#{self.label}' if self.label else f'{self.page}.md'})"

    @property
    def html(self) -> str:
        """Return a link for a piece of HTML: 'figure of chapter 2, “What Murphy's regulators do”'."""
        article = "" if CHAPTER.match(self.page) else "the "
        what = f"{self.kind} of {article}{self.short}" if self.kind else self.short
        target = f"{self.page}.html{'#' * bool(self.label)}{self.label}"
        return f'<a href="{target}">{what}, “{self.title}”</a>'

    @property
    def short(self) -> str:
        """Return 'chapter 2', or a page of the appendix by the words of its file name: 'appendix on arms'."""
        chapter = CHAPTER.match(self.page)
        return f"chapter {int(chapter[1])}" if chapter else f"appendix on {self.page.partition('-')[2]}"


@functools.cache
def read_places() -> dict[str, tuple[BookPlace, ...]]:
    """Return the places of each claim that has some; ValueError for a label that no page has."""
    pages = {path.stem: path.read_text(encoding="utf-8") for path in REPORT.glob("pages/*.md")}
    titles = {page: TITLE.search(text)[1] for page, text in pages.items()}  # type: ignore[index]
    known = {page: BookPlace("", page, title) for page, title in titles.items()}
    for page, text in pages.items():
        for groups in LABEL.findall(text):
            label = "".join(groups)
            known[label] = BookPlace(label, page, titles[page])
    named = tomllib.loads(Path(__file__).with_name("where.toml").read_text(encoding="utf-8"))
    for claim, labels in named.items():
        if unknown := sorted(set(labels) - set(known)):
            raise ValueError(f"where.toml: {claim} names {unknown}, which no page has (cure: write its label)")
    return {claim: tuple(known[label] for label in labels) for claim, labels in named.items()}
