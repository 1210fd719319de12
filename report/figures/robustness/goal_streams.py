"""Goals that arrive as a stream: what filling them in makes of the goal, and of the loop."""

from __future__ import annotations

import math

import pandas as pd

from report.figures.kit.page import Run
from tasks.goal_stream import PERIOD_S

RIGHT = "log"


def streamed(run: Run) -> pd.DataFrame:
    """Rows, words as text."""
    return run.rows("goal-streams").astype({"stream": str, "law": str})


def facts(run: Run) -> dict:
    """Return the worst of the filters, and of the quaternion taken as it came."""
    rows = streamed(run)
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
