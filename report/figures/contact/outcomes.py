"""Tasks in contact in one table: what each is measured by, by controller and frame of the hand."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import pandas as pd

from report.figures.contact.rows import PAPERS, PAPERS_EULER, of
from report.figures.kit import html
from report.figures.kit.tables import Table

SPRINGS = "impedance-geometric"
DEGREES = 180.0 / np.pi


class Measure(NamedTuple):
    """A column of compliance.parquet in the table: its words, unit there and factor to it, a format.

    middle: what stands for several episodes, "median", or "mean" of what is counted.
    failed: what an episode counts as that fails before it has a value: the worst there is.
    """

    column: str
    title: str
    unit: str
    factor: float = 1.0
    form: str = ".2f"
    middle: str = "median"
    failed: float = np.inf

    def of(self, rows: pd.DataFrame) -> str:
        """Return the median or mean of the rows; a dash where at least half of the episodes failed."""
        value = (rows[self.column] * self.factor).fillna(self.failed).agg(self.middle)
        return f"{value:{self.form}}" if np.isfinite(value) else html.MISSING


MEASURES = {
    "surface-alignment": (
        Measure("alignment_error_rad", "tool to plate at the end", "deg", DEGREES),
        Measure("held_turn_rad", "turned about the held axis", "deg", DEGREES),
    ),
    "peg-in-hole": (
        Measure("insertion_depth_m", "depth of insertion", "mm", 1e3, ".1f", failed=-np.inf),
        Measure("jam", "not in at the end", "%", 100.0, ".0f", "mean", 100.0),
    ),
    "crank": (
        Measure("crank_angle_rad", "turned by", "deg", DEGREES, ".1f", failed=-np.inf),
        Measure("moment_error_rms_nm", "moment where it complies, rms", "N m"),
    ),
    "force-on-plane": (
        Measure("normal_force_error_n", "normal force, rms error", "N"),
        Measure("held_turn_rad", "turned about held axes", "deg", DEGREES),
    ),
}
"""Task -> the two numbers that say how it went, the tasks whose orders free turns first."""

OUTCOMES = Table(
    "Task | Measured | Episodes | Cartesian | Euler Jacobian, level | Euler Jacobian, leaning most | Springs",
    words=("Cartesian", "Euler Jacobian, level", "Euler Jacobian, leaning most", "Springs"),
)


def table_of_tasks(rows: pd.DataFrame) -> html.Markdown | None:
    """Return the table."""
    return OUTCOMES(compare_tasks(rows))


def compare_tasks(rows: pd.DataFrame) -> Iterator[tuple]:
    """Return a row a task and measure: Cartesian control, the Euler Jacobian by frame of the hand, springs."""
    for task, own in rows.groupby("task", sort=False):
        euler = of(own, PAPERS_EULER)
        columns = (
            of(own, PAPERS),
            euler[euler["beta_deg"] == 0.0],
            euler[euler["beta_deg"] == euler["beta_deg"].max()],
            of(own, SPRINGS),
        )
        for measure in MEASURES[str(task)]:
            what = f"{measure.title} [{measure.unit}]"
            yield str(task).replace("-", " "), what, len(columns[0]), *map(measure.of, columns)
