"""Times a tick, as a machine's file holds them."""

from __future__ import annotations

import json
from pathlib import Path

from bench.experiments.tables.store import read_arrow
from report.figures.kit.page import Run


def files(run: Run) -> list[Path]:
    """One file a kind of machine."""
    return sorted((run.studies / "timings").glob("*.parquet"))


def said(run: Run) -> str:
    """On which machine, and when; or that there is no timing yet."""
    paths = files(run)
    if not paths:
        return "No law has been timed yet (`make time` does)."
    table = read_arrow(paths[0], "timings")
    about, passes = json.loads(table.schema.metadata[b"about"]), max(table["passes"].to_pylist())
    return f"Measured on {about['cpu']}, {about['cores']} cores, {about['date'][:10]}, {passes} passes."
