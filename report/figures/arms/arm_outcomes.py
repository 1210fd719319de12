"""How episodes on arms end: what settles, what failures came near, what turning asks of the arm."""

from __future__ import annotations

import pandas as pd

from report.figures.arms import arm_rows
from report.figures.kit import html
from report.figures.kit.tables import Table

CAUSES = {"representation": "Coordinates", "kinematic": "Arm", "both": "Both", "torque": "Torque", "law": "Law"}
"""What the judge saw of a failure -> its column."""

SETTLED = Table({"Controller": "", **dict.fromkeys(arm_rows.SETS, ".0f")})
FAILED = Table(" | ".join(("Controller", "Episodes", "Failed", *CAUSES.values())))


def settling(rows: pd.DataFrame) -> html.Markdown | None:
    """A controller a line: share of each start set that settles [%].

    Args:
        rows: of `arm_rows.episodes`, by the standard inverse.
    """
    lines = []
    for controller in arm_rows.in_order(rows):
        own = rows[rows["controller"] == controller]
        shares = 100.0 * arm_rows.settled(own).groupby(own["start_set"]).mean()
        lines.append({"Controller": arm_rows.title(controller), **shares})
    return SETTLED(lines)


def tallied(rows: pd.DataFrame) -> pd.DataFrame:
    """A row a controller: failed episodes by cause, and how many episodes and failures there are."""
    failed = rows[~arm_rows.settled(rows)]
    counts = pd.crosstab(failed["controller"], failed["cause"].astype(str))
    counts = counts.reindex(index=arm_rows.in_order(rows), columns=list(CAUSES), fill_value=0)
    return counts.assign(episodes=rows.groupby("controller").size(), failed=counts.sum(axis=1))


def failing(counts: pd.DataFrame) -> html.Markdown | None:
    """Return the failed episodes by cause as a table."""
    columns = ["episodes", "failed", *CAUSES]
    return FAILED((arm_rows.title(str(name)), *line[columns]) for name, line in counts.iterrows())


def possible(rows: pd.DataFrame) -> float:
    """Share of episodes within the rated torques [%]."""
    return 100.0 * float((rows["peak_torque_ratio"] <= 1.0).mean())
