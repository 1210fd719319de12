"""A perturbation as tables, laws by levels: how it went, and what it took."""

from __future__ import annotations

import numpy as np
import pandas as pd

import tasks
from bench.tables.statistics import quantile
from report.figures.comparison.cells import by_family, large
from report.figures.kit import html
from report.figures.robustness.rows import DEG, LASTING, laws, levels, nominal, of, with_unit, worst

COSTS = {
    "Effort": lambda rows: large(float(rows["effort"].median())),
    "Peak [rad/s²]": lambda rows: large(float(rows["peak_u"].median())),
    "Variation [rad/s²]": lambda rows: large(float(rows["variation"].median())),
    "Overshoot [deg]": lambda rows: f"{DEG * rows['overshoot_rad'].max():.1f}",
    "Path": lambda rows: f"{rows['path_ratio'].median():.2f}",
}
"""Title -> what is written of the rows: medians, and of the overshoot the largest."""


def by_level(rows: pd.DataFrame, name: str) -> html.Markdown | None:
    """Median and worst of what counts under this perturbation, and how many starts do not go well, if any.

    Args:
        rows: of `rows.along`. name: of the perturbation.
    """
    write = _error if name in LASTING else _time

    def line(law: str) -> dict:
        there = dict(iter(of(rows, law).groupby("level")))
        return {with_unit(one, name): write(there[one]) if one in there else html.MISSING for one in levels(rows)}

    return by_family(laws(rows), line)


def _time(rows: pd.DataFrame) -> str:
    median, slowest = (float(quantile(rows["time_s"].to_numpy(), level)) for level in (0.5, 1.0))
    lost = int((~rows["good"]).sum())
    if lost:
        return (
            "all fail" if lost == len(rows) else f"{lost} fail" if np.isinf(median) else f"{median:.2f} ({lost} fail)"
        )
    return f"{median:.2f}, {slowest:.2f}"


def _error(rows: pd.DataFrame) -> str:
    median, largest = (DEG * float(quantile(rows["tail_rms_rad"].to_numpy(), level)) for level in (0.5, 1.0))
    lost = int((~rows["good"]).sum())
    return f"{_degrees(median)} ({lost} lost)" if lost else f"{_degrees(median)}, {_degrees(largest)}"


def _degrees(angle: float) -> str:
    return f"{angle:.2g}" if angle < 10.0 else f"{angle:.0f}"


def costs(rows: pd.DataFrame, name: str) -> html.Markdown | None:
    """What it takes, unperturbed and, after an arrow, at the worst level: of the starts that go well at both."""

    def line(law: str) -> dict:
        ends = (nominal(tasks.axis(name)), worst(rows, name))
        parts = [of(rows, law, level).set_index("start_id") for level in ends]
        both = parts[0].index[parts[0]["good"]].intersection(parts[1].index[parts[1]["good"]])
        here, there = (part.loc[both] for part in parts)
        if here.empty:
            return dict.fromkeys(COSTS, html.MISSING)
        return {title: f"{write(here)} → {write(there)}" for title, write in COSTS.items()}

    return by_family(laws(rows), line)


def usual(rows: pd.DataFrame, name: str) -> dict:
    """The two tables of a page on one perturbation."""
    return {"tab_levels": by_level(rows, name), "tab_costs": costs(rows, name)}
