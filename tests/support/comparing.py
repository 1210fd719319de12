"""Runs for the gate to compare, and one of them changed."""

from pathlib import Path

from bench.experiments.plan import Plan
from bench.experiments.tables.store import read, write_table
from bench.running import run as running


def ran(plan: Plan, tmp_path_factory) -> Path:
    """The folder of a run."""
    folder = tmp_path_factory.mktemp("gate") / "reference"
    running.run(plan, folder, workers=1)
    return folder


def change(folder: Path, table: str, edit) -> None:
    """Put edit(frame) in the place of a table."""
    frame = read(folder, table)
    write_table(folder / f"{table}.parquet", edit(frame), table)
