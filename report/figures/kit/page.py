"""A page's module pasted into its page, and the words where the run does not hold what the page shows.

The page pages/05-settling-time.md has the module responses/settling_time.py (the front page, `index`), whose functions
facts(run), tables(run) and figures(run) give what it pastes, key by key; a page may do without any of them. A value
that is None, or a key that is left out, is not in this run, and the page says so.
"""

from __future__ import annotations

import functools
import importlib
import re
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import pandas as pd

from bench.tables import read
from bench.tables.schema import RESULTS
from report.figures.kit import html, style
from report.figures.kit.inline import responsive_picture

REPORT = Path(__file__).resolve().parents[2]
ABSENT = "not in this run"
PARTS = ("facts", "tables", "figures")
INLINE = re.compile(r"\{glue:(text|md)\}`([^`:]+)")
BLOCK = re.compile(r"^\s*(?:`{3,}|:{3,})\{glue:?(md|figure|)\}\s+(\S+)", re.MULTILINE)


class Run:
    """The run that is shown, beside the studies that are committed: timings, history, faults, kills."""

    def __init__(self, folder: Path, studies: Path = RESULTS):
        self.folder, self.studies = folder, studies

    def rows(self, table: str, **words: str) -> pd.DataFrame:
        """Rows of one of its tables that have these words; none where it has no such table."""
        is_there = (self.folder / f"{table}.parquet").is_file()
        return read.chosen(read.table(self.folder, table), words) if is_there else pd.DataFrame()


@functools.cache
def run_in(folder: Path) -> Run:
    """One object a folder, so that what is computed from a run is computed once (functools.cache)."""
    return Run(folder)


def given(rows: pd.DataFrame, make: Callable[[pd.DataFrame], Any]) -> Any:
    """make(rows); None, for which the page says that it is not in this run, if there are no rows."""
    return make(rows) if len(rows) else None


def page(name: str) -> None:
    """Paste all of a page: page("responses.settling_time")."""
    from myst_nb import glue

    module = importlib.import_module(f"report.figures.{name}")
    for key, value in contents(module, run_in(read.folder()), text_of(name)).items():
        glue(key, value, display=False)


def text_of(name: str) -> str:
    """The Markdown of the page that a module belongs to."""
    stem = name.rpartition(".")[2].replace("_", "-")
    (path,) = [REPORT / "index.md"] if stem == "index" else REPORT.glob(f"pages/??-{stem}.md")
    return path.read_text(encoding="utf-8")


def contents(module: ModuleType, run: Run, text: str) -> dict[str, Any]:
    """What a page pastes, as it pastes it."""
    found = {key: value for part in PARTS if hasattr(module, part) for key, value in getattr(module, part)(run).items()}
    return {key: as_pasted(found.get(key), kind, key) for key, kind in pasted(text).items()}


def pasted(text: str) -> dict[str, str]:
    """Keys that a page pastes -> fact, sentence, table, figure or piece."""
    inline = {key: "fact" if how == "text" else "sentence" for how, key in INLINE.findall(text)}
    return inline | {key: {"md": "table", "": "piece"}.get(how, how) for how, key in BLOCK.findall(text)}


def as_pasted(value: Any, kind: str, key: str) -> Any:
    """A fact as a word, a sentence or a table as Markdown, a drawing as it is; of each kind its own words for None."""
    if value is None:
        return absent(key, kind)
    if kind == "fact":
        return html.cell(value)
    return html.Markdown(value) if kind in ("sentence", "table") else value


def absent(key: str, kind: str) -> Any:
    """What stands in place of something that this run does not hold."""
    if kind == "figure":
        return blank(key.replace("-", " ").replace("_", " ").capitalize())
    if kind == "table":
        return html.table(pd.DataFrame({"Rows": [ABSENT]}))
    return {"fact": ABSENT, "sentence": html.Markdown(f"This is {ABSENT}.")}.get(kind, html.Html(f"<p>{ABSENT}</p>"))


@responsive_picture
def blank(what: str, narrow: bool):
    """The words alone, in the place of a figure."""
    return style.words(f"{what}: {ABSENT}", narrow, height=0.6), f"{what}: {ABSENT}. The default suite holds it."
