"""The later laws on arms, beside the paper's three: what settles, and when, by the geometric Jacobian."""

from __future__ import annotations

import functools

import pandas as pd

from bench.experiments.suites import BEST
from report.figures.arms import arm_rows
from report.figures.kit import families
from report.figures.kit.laws import TITLES
from report.figures.kit.page import Run


@functools.cache
def rows(run: Run) -> pd.DataFrame:
    """Episodes of the paper's three and of the best later laws by the geometric Jacobian and the standard inverse."""
    every = arm_rows.episodes(run)
    laws = [*TITLES, *(word.partition("@")[0] for word in BEST)]
    is_wanted = (every["way"] == every["law"] + f"@geometric+{arm_rows.STANDARD}") & every["law"].isin(laws)
    return every[is_wanted]


def facts(found: pd.DataFrame) -> dict:
    """How many later laws ran on arms, and of all laws the one that settles most and the one that settles least."""
    shares = arm_rows.settled(found).groupby(found["law"]).mean()
    later = shares[[law for law in shares.index if law not in TITLES]]
    return {
        "arms": found["arm"].nunique(),
        "arm_laws": len(later),
        "arm_starts": len(found) // max(1, len(shares)),
        "arm_most": families.word(str(shares.idxmax())),
        "arm_most_share": f"{100 * shares.max():.0f}",
        "arm_least": families.word(str(shares.idxmin())),
        "arm_least_share": f"{100 * shares.min():.0f}",
        "arm_alike": "all alike"
        if later.nunique() <= 1
        else f"from {100 * later.min():.0f} to {100 * later.max():.0f} %",
    }
