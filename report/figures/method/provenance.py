"""What the page on provenance shows: the run, its files with links to take them."""

import re
from pathlib import Path
from typing import Any

import pandas as pd
import pyarrow.parquet as pq

from bench.base.provenance import ROOT
from bench.experiments.tables import read
from bench.experiments.tables.schema import all_tables
from report.figures.cost.cost import timings
from report.figures.kit import html
from report.figures.kit.offered import OFFERED_BYTES, SITE_DATA
from report.figures.kit.page import Run

CITATION = ROOT / "CITATION.cff"
FACTS = html.Table("Fact | Value")
FILES = html.Table("File | Rows | Size [kB]:.0f")


def facts(run: Run) -> dict[str, Any]:
    """Return the title and the version that are cited, with its date; the run and its files."""
    said = cited()
    version = f"{said['version']} ({said['date-released']})" if "date-released" in said else said["version"]
    files = FILES(map(describe_file, list_files(run)))
    return {"title": said["title"], "version": version, "run": describe_run(read.provenance()), "tables": files}


def cited() -> dict[str, str]:
    """Return title, version and date of CITATION.cff."""
    text = CITATION.read_text(encoding="utf-8")
    return dict(re.findall(r"^(title|version|date-released): *[\"']?([^\"'\n]+)", text, re.MULTILINE))


def describe_run(given: dict[str, Any]) -> html.Markdown | None:
    """Return the facts of provenance.json, which may come from anywhere, as a table."""
    facts = pd.json_normalize(given, sep=" ").iloc[0]
    return FACTS((html.foreign(name), html.foreign(value)) for name, value in facts.items())


def list_files(run: Run) -> list[Path]:
    """Return the files of the run, tables first, then every machine's timings."""
    names = [*(f"{name}.parquet" for name in sorted(all_tables())), "provenance.json", "plan.json"]
    return [*(path for path in (run.folder / name for name in names) if path.is_file()), *timings(run)]


def describe_file(path: Path) -> tuple:
    """Return a link to a file, or its name where it is too large to offer; its rows and size."""
    rows = pq.read_metadata(path).num_rows if path.suffix == ".parquet" else None
    name = f"timings/{path.name}" if path.parent.name == "timings" else path.name
    is_large = path.stat().st_size > OFFERED_BYTES
    link = f"`{name}` (too large for this site)" if is_large else f'<a href="{SITE_DATA}/{name}" download>{name}</a>'
    return link, rows, path.stat().st_size / 1e3
