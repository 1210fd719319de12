"""An axis of trouble as tables, laws by levels: how it went, and what it took."""

from __future__ import annotations

import numpy as np
import pandas as pd

import tasks
from bench.tables.statistics import quantile
from report.figures.comparison.comparison_tables import by_family, large
from report.figures.kit import html
from report.figures.robustness import robustness_rows
from report.figures.robustness.robustness_rows import LASTING

DEG = 180.0 / np.pi


def levels(rows: pd.DataFrame, name: str) -> html.Markdown:
    """Median and worst of what counts on this axis, and how many starts do not go well, if any.

    Args:
        rows: of `robustness_rows.along`. name: of the axis.
    """
    write = _error if name in LASTING else _time

    def line(_, own: pd.DataFrame) -> dict:
        by_level = dict(iter(own.groupby("level")))
        return {
            robustness_rows.said(level, name): write(by_level[level]) if level in by_level else html.MISSING
            for level in robustness_rows.levels(rows)
        }

    return by_family(rows, line)


def _time(rows: pd.DataFrame) -> str:
    median, worst = (float(quantile(rows["time_s"].to_numpy(), level)) for level in (0.5, 1.0))
    lost = int((~rows["good"]).sum())
    if lost:
        return (
            "all fail" if lost == len(rows) else f"{lost} fail" if np.isinf(median) else f"{median:.2f} ({lost} fail)"
        )
    return f"{median:.2f}, {worst:.2f}"


def _error(rows: pd.DataFrame) -> str:
    median, worst = (DEG * float(quantile(rows["tail_rms_rad"].to_numpy(), level)) for level in (0.5, 1.0))
    lost = int((~rows["good"]).sum())
    return f"{_degrees(median)} ({lost} lost)" if lost else f"{_degrees(median)}, {_degrees(worst)}"


def _degrees(angle: float) -> str:
    return f"{angle:.2g}" if angle < 10.0 else f"{angle:.0f}"


def costs(rows: pd.DataFrame, name: str) -> html.Markdown:
    """What it takes, without trouble and, after an arrow, at the worst level: of the starts that go well at both.

    Args:
        rows: of `robustness_rows.along`. name: of the axis.
    """
    ends = (robustness_rows.nominal(tasks.axis(name)), robustness_rows.worst(rows, name))

    def line(law: str, _) -> dict:
        parts = [robustness_rows.of(rows, law, level).set_index("start_id") for level in ends]
        both = parts[0].index[parts[0]["good"]].intersection(parts[1].index[parts[1]["good"]])
        here, there = (part.loc[both] for part in parts)
        if here.empty:
            return dict.fromkeys(COSTS, html.MISSING)
        return {title: f"{write(here)} → {write(there)}" for title, write in COSTS.items()}

    return by_family(rows, line)


def _median(column: str):
    return lambda rows: large(float(rows[column].median()))


COSTS = {
    "Effort": _median("effort"),
    "Peak [rad/s²]": _median("peak_u"),
    "Variation [rad/s²]": _median("variation"),
    "Overshoot [deg]": lambda rows: f"{DEG * rows['overshoot_rad'].max():.1f}",
    "Path": lambda rows: f"{rows['path_ratio'].median():.2f}",
}
"""Title -> what is written of the rows: medians, and of the overshoot the largest."""
