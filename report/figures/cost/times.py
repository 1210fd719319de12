"""Times a tick, as a machine's file holds them."""

from __future__ import annotations

import json
from pathlib import Path

import pandas as pd

from bench.experiments.tables.read import with_contender
from bench.experiments.tables.store import read_arrow
from report.figures.kit.page import Run


def files(run: Run) -> list[Path]:
    """One file a kind of machine."""
    return sorted((run.studies / "timings").glob("*.parquet"))


def read(path: Path) -> pd.DataFrame:
    """Return a machine's rows with `contender` added."""
    return with_contender(read_arrow(path, "timings").to_pandas())


def alone(frame: pd.DataFrame) -> pd.DataFrame:
    """Laws timed alone, the fastest first; a law that could not be timed is left out."""
    rows = frame[(frame["what"] == "law") & (frame["ticks"] > 0)]
    return rows.sort_values("ratio", kind="stable").reset_index(drop=True)


def said(run: Run) -> str:
    """On which machine, and when; or that there is no timing yet."""
    paths = files(run)
    if not paths:
        return "No law has been timed yet (`make time` does)."
    about = json.loads(read_arrow(paths[0], "timings").schema.metadata[b"about"])
    passes = int(read(paths[0])["passes"].max())
    return f"Measured on {about['cpu']}, {about['cores']} cores, {about['date'][:10]}, {passes} passes."
