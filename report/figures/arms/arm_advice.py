"""What the run advises: which controller for evenly spread starts, which inverse for it, and what damping does."""

from __future__ import annotations

from collections.abc import Callable

import pandas as pd

from bench.findings.claims.verdict import NoEvidence
from bench.findings.selection import needs
from report.figures.arms import arm_rows
from report.figures.kit import families, html
from report.figures.kit.page import ABSENT, Run
from report.figures.kit.share import share

FEWEST = 2
"""Ways to choose between: with fewer there is no choice to advise on."""


def told(rows: pd.DataFrame, is_good: Callable[[pd.DataFrame], pd.Series] = arm_rows.settled) -> str:
    """Share that settles, or is good otherwise, with its interval and n, in words."""
    found = share(int(is_good(rows).sum()), len(rows))
    return f"{100 * found.value:.1f} % ({100 * found.low:.1f} to {100 * found.high:.1f} %, n = {found.n})"


def within_rated(rows: pd.DataFrame) -> pd.Series:
    """Whether each episode settled within the rated torques."""
    return arm_rows.settled(rows) & (rows["peak_torque_ratio"] <= 1.0)


def same_both_ways(rows: pd.DataFrame) -> str | None:
    """How many episodes of the Euler law end alike by (2.2) with (2.15) and by (3.7)."""
    pair = [arm_rows.of(rows, controller) for controller in (arm_rows.SAME_BOTH_WAYS, arm_rows.ON_ANGLES)]
    both = pair[0].merge(pair[1], on=["arm", "start_set", "start_id"])
    if both.empty:
        return None
    alike = int((both["outcome_x"] == both["outcome_y"]).sum())
    return f"{alike} of {len(both)}"


def in_words(inverse: str) -> str:
    """An inverse's title inside a sentence."""
    title = arm_rows.title_of_inverse(inverse)
    return title[:1].lower() + title[1:]


def advice(rows: pd.DataFrame, run: Run) -> dict:
    """The law that is advised for an arm (`selection.needs`), and what the evenly spread starts say of its inverse."""
    uniform = rows[rows["start_set"] == "uniform"]
    law = advised(run)
    controller = f"{law}@geometric" if law else arm_rows.ON_MATRIX
    values = {
        "best": families.word(law) if law else "none from this run; by the rotation matrix",
        "best_share": told(arm_rows.of(uniform, controller)),
        "best_rated": told(arm_rows.of(uniform, controller), within_rated),
        "euler_share": told(arm_rows.of(uniform, arm_rows.ON_ANGLES)),
        "euler_rated": told(arm_rows.of(uniform, arm_rows.ON_ANGLES), within_rated),
    }
    whose, own = "it", uniform[uniform["controller"] == controller]
    if own["way"].nunique() < FEWEST:
        whose, own = "the rotation matrix by (2.2)", uniform[uniform["controller"] == arm_rows.ON_MATRIX]
    ways = own.assign(good=arm_rows.settled(own), strays=own["position_error_m"]).groupby("way")
    table = pd.DataFrame({"good": ways["good"].mean(), "strays": ways["strays"].median(), "n": ways.size()})
    if len(table) < FEWEST:
        return values | {"inverse_advice": f"Which inverse is best is {ABSENT}."}
    best = table.sort_values(["good", "strays"], ascending=[False, True]).index[0]
    inverse = best.partition("+")[2]
    return values | {
        "inverse_advice": f"With the inverse “{in_words(inverse)}” {whose} settles {told(own[own['way'] == best])} and "
        f"strays {html.number(1e3 * table.loc[best, 'strays'])} mm in the median."
    }


def advised(run: Run) -> str | None:
    """The law for an arm; None in a run that cannot tell."""
    try:
        return needs.advice(run.folder).of(needs.ARM).law
    except NoEvidence:
        return None
