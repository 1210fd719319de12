"""Goals that arrive as a stream: what filling them in makes of the goal, and of the loop."""

from __future__ import annotations

import math

import pandas as pd

from report.figures.kit import html
from report.figures.kit.page import Run
from report.figures.kit.tables import Table
from tasks.goal_stream import PERIOD_S, STREAMS

STREAM_TABLE = Table(
    "Goals arrive as | Filled in | Goal's rate:.3g | Goal's way:.2f | Laws' peak [rad/s²] | Off [°]:.0f "
    "| As it came, way"
)
RIGHT = "log"


def streamed(run: Run) -> pd.DataFrame:
    """Rows, words as text."""
    rows = run.any_rows("goal-streams")
    return rows.astype({"stream": str, "law": str}) if len(rows) else rows


def facts(run: Run) -> dict:
    """Return the worst of the filters, and of the quaternion taken as it came."""
    rows = streamed(run)
    if rows.empty:
        return {}
    laws, raw = rows[rows["law"] != ""], rows[rows["law"] == ""]
    swept = laws[laws["stream"] != "held"]
    return {
        "worst_rate": f"{swept['goal_rate_ratio'].max():.0f}",
        "worst_peak": f"{swept['peak_u'].max():.0f}",
        "right_peak": f"{swept.loc[swept['stream'] == RIGHT, 'peak_u'].max():.0f}",
        "period": f"{1000 * PERIOD_S:g}",
        "raw_way": f"{raw['way_ratio'].max():.1f}",
        "raw_off": f"{math.degrees(raw['off_rad'].max()):.0f}",
    }


def tables(run: Run) -> dict:
    """Return a row a stream: the goal, the laws from the least to the most, the quaternion as it came."""
    rows, lines = streamed(run), []
    for stream in STREAMS if len(rows) else ():
        own = rows[rows["stream"] == stream.name]
        laws, raw = own[own["law"] != ""], own[own["law"] == ""]
        peaks = f"{laws['peak_u'].min():.0f} to {laws['peak_u'].max():.0f}"
        way = f"{raw['way_ratio'].iloc[0]:.2f}" if len(raw) else html.MISSING
        goal = own.iloc[0]
        off = math.degrees(laws["off_rad"].max())
        lines.append((stream.arrives, stream.between, goal["goal_rate_ratio"], goal["goal_way_ratio"], peaks, off, way))
    return {"streams": STREAM_TABLE(lines) if lines else None}
