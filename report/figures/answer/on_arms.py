"""The later laws on arms, beside the paper's three: what settles, and when, by the geometric Jacobian."""

from __future__ import annotations

import functools

import pandas as pd

from bench.experiments.suites import BEST
from report.figures.arms import arm_looks, arm_rows
from report.figures.kit import families, html
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


def table(found: pd.DataFrame) -> html.Markdown:
    """A row a law: episodes that settle on each arm, on all of them, and the median settling time of clear starts."""
    lines = []
    for law in families.in_order(found["law"].unique()):
        own = found[found["law"] == law]
        cells = {arm: _settled(own[own["arm"] == arm]) for arm in arm_looks.arms(found)}
        clear = own.loc[(own["start_set"] == "clear") & arm_rows.settled(own), "settling_time_s"]
        line = {"Law": families.link(law, families.word(law)), **cells, "All": _settled(own)}
        lines.append({**line, "Clear starts, median [s]": f"{clear.median():.3f}" if len(clear) else html.MISSING})
    return html.table(pd.DataFrame(lines))


def _settled(own: pd.DataFrame) -> str:
    return f"{int(arm_rows.settled(own).sum())} of {len(own)}"
