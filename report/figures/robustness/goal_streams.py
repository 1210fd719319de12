"""Goals that arrive as a stream: the worst of the filters between them, and of the quaternion taken as it came."""

import math

from bench.experiments.tables.run import Run
from report.figures.kit import html
from tasks.goal_stream import PERIOD_S


def facts(run: Run) -> dict[str, str]:
    """Return by how much filters turn a goal too fast, and what the quaternion as it came does."""
    rows = run.rows("goal-streams").astype({"stream": str, "law": str})
    swept, raw = rows[(rows["law"] != "") & (rows["stream"] != "held")], rows[rows["law"] == ""]
    return {
        "worst_rate": html.number(float(f"{swept['goal_rate_ratio'].max():.2g}")),
        "period": f"{1000 * PERIOD_S:g}",
        "raw_way": f"{raw['way_ratio'].max():.1f}",
        "raw_off": f"{math.degrees(raw['off_rad'].max()):.0f}",
    }
