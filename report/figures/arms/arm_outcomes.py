"""How episodes on arms end: what settles, what failures came near, what turning asks of the arm."""

from __future__ import annotations

from collections.abc import Iterator

import pandas as pd

from report.figures.arms import arm_rows
from report.figures.arms.arm_looks import arms
from report.figures.kit import html
from report.figures.kit.tables import Table

CAUSES = {"representation": "Coordinates", "kinematic": "Arm", "both": "Both", "torque": "Torque", "law": "Law"}
"""What the judge saw of a failure -> its column."""

LEAST_MM = 1e-3
"""Smaller position errors are rounding, of an arm whose tool is the centre of its wrist."""


def millimetres(value: float) -> str:
    """A distance; one that is nothing but rounding as less than LEAST_MM."""
    return f"< {LEAST_MM:g}" if value < LEAST_MM else html.number(value)


SETTLED = Table({"Controller": "", **dict.fromkeys(arm_rows.SETS, ".0f")})
FAILED = Table(" | ".join(("Controller", "Episodes", "Failed", *CAUSES.values())))
STRAIN = Table(
    "Arm | Strays, (2.2) [mm] | Strays, (3.7) [mm] | Torque, (2.2) | Torque, (3.7) | Within, clear [%]:.0f | "
    "Within, all [%]:.0f",
    dict.fromkeys(("Strays, (2.2) [mm]", "Strays, (3.7) [mm]"), millimetres),
)


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
    """The same as a table."""
    columns = ["episodes", "failed", *CAUSES]
    return FAILED((arm_rows.title(str(name)), *line[columns]) for name, line in counts.iterrows())


def strain(rows: pd.DataFrame) -> Iterator[tuple]:
    """An arm a line: medians over clear starts of both controllers; episodes of all within the rated torques.

    Args:
        rows: of `arm_rows.episodes`, by the standard inverse.
    """
    for arm in arms(rows):
        own = rows[rows["arm"] == arm]
        clear = own[own["start_set"] == "clear"]
        both = [arm_rows.of(clear, controller) for controller in arm_rows.PAPERS_TWO]
        strays = (1e3 * one["position_error_m"].median() for one in both)
        torques = (one["peak_torque_ratio"].median() for one in both)
        yield arm, *strays, *torques, possible(clear), possible(own)


def possible(rows: pd.DataFrame) -> float:
    """Share of episodes within the rated torques [%]."""
    return 100.0 * float((rows["peak_torque_ratio"] <= 1.0).mean())
