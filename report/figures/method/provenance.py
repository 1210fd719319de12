"""What the page on provenance shows: the run, its tables with their digests, and links to take them."""

from __future__ import annotations

import hashlib
import re
from pathlib import Path

import pyarrow.parquet as pq

from bench.base.provenance import ROOT, count_episodes, rounded_on
from bench.experiments.tables import read
from bench.experiments.tables.schema import all_tables
from report.figures.cost import times
from report.figures.kit import html
from report.figures.kit.page import Run
from report.figures.kit.tables import Table

OFFERED_BYTES = 8_000_000
"""A larger file is named, not offered: the site stays small enough to be mailed or put on a stick."""
CITATION = ROOT / "CITATION.cff"
SITE_DATA = "../data"
"""Seen from a page in pages/; report/build.py copies there what pages link to."""
FACTS = Table("Fact | Value")
FILES = Table("File | Rows | Size | SHA-256")


def facts(_: Run) -> dict:
    """Return the title and the version that are cited, with its date."""
    said = cited()
    version = f"{said['version']} ({said['date-released']})" if "date-released" in said else said["version"]
    return {"title": said["title"], "version": version}


def cited() -> dict[str, str]:
    """Return title, version and date of CITATION.cff."""
    text = CITATION.read_text(encoding="utf-8")
    return dict(re.findall(r"^(title|version|date-released): *[\"']?([^\"'\n]+)", text, re.MULTILINE))


def tables(run: Run) -> dict:
    """Return the run and its files."""
    return {
        "run": FACTS(said_of_itself(read.provenance()).items()),
        "tables": FILES(map(offered, files(run))),
    }


def digest(path: Path) -> str:
    """SHA-256 of a file, in hex."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def spelled(hex_digits: str) -> str:
    """Return a digest that may break into lines at every quarter, and is copied whole."""
    quarter = len(hex_digits) // 4
    parts = [hex_digits[at : at + quarter] for at in range(0, len(hex_digits), quarter)]
    return f'<code class="digest">{"<wbr>".join(parts)}</code>'


def files(run: Run) -> list[Path]:
    """Return the files of the run, tables first, then every machine's timings."""
    names = [*(f"{name}.parquet" for name in sorted(all_tables())), "provenance.json", "plan.json"]
    return [*(path for path in (run.folder / name for name in names) if path.is_file()), *times.files(run)]


def said_of_itself(given: dict) -> dict[str, str]:
    """provenance.json in words."""
    said = {name: escaped(value) for name, value in given.items()}
    changed = "yes: the sources had changes that no commit holds" if said["dirty"] else "no"
    return {
        "Suite": f"{code(given['suite'])}, {html.number(count_episodes(given))} episodes",
        "Command": code(given["command"]),
        "Seed": f"{said['seed']}",
        "Finished": said["finished"].replace("T", " ").replace("Z", " UTC"),
        "Wall time": f"{said['wall_s']:.0f} s with {said['workers']} workers",
        "Resumed after a stop": "yes" if said["resumed"] else "no",
        "Commit": code(given["commit"]) if said["commit"] else "none: not a checkout",
        "Uncommitted changes": changed,
        "Digest of the sources": code(given["sources"]),
        "Digest of the plan": code(given["plan"]),
        "Processor": f"{html.foreign(rounded_on(given))}, {said['cores']} cores",
        "System": said["platform"],
        **{html.foreign(name): version for name, version in sorted(said["versions"].items())},
        "Lock requirements/base.txt, SHA-256": spelled(said["lock"]) if said["lock"] else "none",
    }


def code(text: str) -> str:
    """Return a text as Markdown's code, in which nothing is markup: between more backticks than it holds in a row."""
    text = " ".join(str(text).split())
    fence = "`" * (1 + max(map(len, re.findall("`+", text)), default=0))
    return f"{fence} {text} {fence}" if "`" in text else f"`{text}`"


def escaped(value):
    """Return a value of provenance.json as a page may show it: the file may come from anywhere."""
    if isinstance(value, dict):
        return {name: escaped(one) for name, one in value.items()}
    return html.foreign(value) if isinstance(value, str) else value


def offered(path: Path) -> tuple:
    """Return a file: a link to it, its rows, size and digest."""
    rows = pq.read_metadata(path).num_rows if path.suffix == ".parquet" else None
    return link(path), rows, size(path.stat().st_size), spelled(digest(path))


def link(path: Path) -> str:
    """Return the file as a link, or its bare name where it is too large to offer."""
    name = f"timings/{path.name}" if path.parent.name == "timings" else path.name
    if path.stat().st_size > OFFERED_BYTES:
        return f"`{name}` (too large for this site)"
    return f'<a href="{SITE_DATA}/{name}" download>{name}</a>'


def size(count: int) -> str:
    """Bytes as a reader takes them in."""
    return (
        f"{count / 1e6:.1f}\N{NO-BREAK SPACE}MB"
        if count >= 1e6
        else f"{max(1, round(count / 1e3))}\N{NO-BREAK SPACE}kB"
    )
