"""Every machine on which laws were timed: one file of results/timings each, whoever sent it."""

from __future__ import annotations

import json
from pathlib import Path

from bench.experiments.tables.store import read_arrow
from bench.findings.selection import needs
from report.figures.cost import times
from report.figures.kit import families
from report.figures.kit.page import Run
from report.figures.kit.rows import FEEDBACK, LINEARIZED, MATRIX
from report.figures.kit.tables import Table


def tables(run: Run) -> dict:
    """A row a machine: the reference kernel's step, and times of laws over that of the rotation-matrix law."""
    advised = needs.advice(run.folder).default.law
    compared = [LINEARIZED, FEEDBACK, *([advised] if advised else [])]
    made = Table(
        " | ".join(
            ("Machine", "Measured", "Laws", "Kernel step [ns]:.1f", *(f"{families.word(one)}:.2f" for one in compared))
        )
    )
    return {"tab_machines": made(row(path, compared) for path in times.files(run))}


def row(path: Path, compared: list[str]) -> list:
    """One machine's line."""
    about = json.loads(read_arrow(path, "timings").schema.metadata[b"about"])
    alone = times.alone(times.read(path)).drop_duplicates("contender").set_index("contender")
    ratios = alone["ratio"].reindex([MATRIX, *compared])
    return [
        f"{about['cpu']}, {about['cores']} cores, {about['platform']}",
        about["date"][:10],
        len(alone),
        alone["ns_reference_kernel"].median(),
        *(ratios.iloc[1:] / ratios.iloc[0]),
    ]
