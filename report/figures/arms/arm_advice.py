"""What the run advises: which controller for evenly spread starts, which inverse for it, and what damping does."""

from __future__ import annotations

import pandas as pd

from report.figures.arms import arm_rows
from report.figures.kit import html
from report.figures.kit.page import ABSENT
from report.figures.kit.share import share

FEWEST = 2
"""Ways to choose between: with fewer there is no choice to advise on."""


def told(rows: pd.DataFrame) -> str:
    """Share that settles with its interval and n, in words."""
    found = share(int(arm_rows.settled(rows).sum()), len(rows))
    return f"{100 * found.value:.1f} % ({100 * found.low:.1f} to {100 * found.high:.1f} %, n = {found.n})"


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


def advice(rows: pd.DataFrame) -> dict:
    """What the evenly spread starts say: which law by the standard inverse, and which inverse for that law."""
    uniform = rows[rows["start_set"] == "uniform"]
    standard = arm_rows.with_standard(uniform)
    shares = standard.assign(good=arm_rows.settled(standard)).groupby("controller")["good"].mean()
    law = str(shares.idxmax())
    values = {
        "best": arm_rows.title(law),
        "best_share": told(arm_rows.of(uniform, law)),
        "euler_share": told(arm_rows.of(uniform, arm_rows.ON_ANGLES)),
    }
    whose, own = "it", uniform[uniform["controller"] == law]
    if own["way"].nunique() < FEWEST:
        whose, own = "the rotation matrix by (2.2)", uniform[uniform["controller"] == arm_rows.ON_MATRIX]
    ways = own.assign(good=arm_rows.settled(own), strays=own["position_error_m"]).groupby("way")
    table = pd.DataFrame({"good": ways["good"].mean(), "strays": ways["strays"].median(), "n": ways.size()})
    if len(table) < FEWEST:
        return values | {"inverse_advice": f"Which inverse is best is {ABSENT}."}
    best = table.sort_values(["good", "strays"], ascending=[False, True]).index[0]
    inverse = best.partition("+")[2]
    return values | {
        "inverse_advice": f"With the inverse “{in_words(inverse)}” {whose} settles "
        f"{told(own[own['way'] == best])} and strays {html.number(1e3 * table.loc[best, 'strays'])} mm in the median."
    }
