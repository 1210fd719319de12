"""The page on a body that spins at first."""

from __future__ import annotations

import math

import pandas as pd

from report.figures.kit import families
from report.figures.kit.page import Run, given
from report.figures.robustness.level_panels import TURNED, panels
from report.figures.robustness.rows import DEG, along, ends, gains, laws, medians, of, slower, worst
from report.figures.robustness.tables import usual

NAME = "spin"

FARTHER = 1.05
"""Ratio of two ways from which one law turns farther than another from the same start."""


def turned(run: Run) -> pd.DataFrame:
    """Rows with `turned_deg`, all that the body turned [deg]."""
    rows = along(run, NAME)
    return rows if rows.empty else rows.assign(turned_deg=DEG * rows["path_ratio"] * rows["angle0_rad"])


def facts(run: Run) -> dict:
    """How far bodies turn, and whether memory sends them the longer way."""
    rows = turned(run)
    if rows.empty:
        return {}
    fastest, (_, kv) = worst(rows, NAME), gains(rows)
    last = rows[(rows["level"] == fastest) & rows["good"]]
    farthest = last.groupby("contender", observed=True)["turned_deg"].max()
    mine = farthest[[law for law in laws(rows, controls=False) if law in farthest]]
    middle, slow = medians(rows, "turned_deg").median(axis=1), slower(rows, NAME)
    hybrid, short = (of(last, law).set_index("start_id")["turned_deg"] for law in ("hybrid", "quaternion-shortest"))
    ratio = (hybrid / short).dropna()
    return {
        **ends(rows, NAME),
        "turns": f"{fastest / (2.0 * math.pi):.1f}",
        "coast": f"{fastest / kv:g}",
        "coast_deg": f"{DEG * fastest / kv:.0f}",
        "rest_deg": f"{middle.iloc[0]:.0f}",
        "spun_deg": f"{middle.loc[fastest]:.0f}",
        "most": f"{mine.max():.0f}",
        "most_law": families.word(mine.idxmax()),
        "unwound": f"{farthest.get('quaternion-unwinding', math.nan):.0f}",
        "longer": int((ratio > FARTHER).sum()),
        "shorter": int((ratio < 1.0 / FARTHER).sum()),
        "both": len(ratio),
        "slowest": f"{100.0 * (slow.max() - 1.0):.0f}",
        "slowest_law": families.word(slow.idxmax()),
    }


def tables(run: Run) -> dict:
    """How it went by spin, and what it took."""
    return usual(along(run, NAME), NAME)


def figures(run: Run) -> dict:
    """All that the body turned, by spin."""
    return {NAME: given(turned(run), lambda rows: panels(rows, NAME, TURNED))}
