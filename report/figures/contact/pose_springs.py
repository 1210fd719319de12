"""Springs of position and orientation: which are springs, and which way they make a hand go."""

from __future__ import annotations

import pandas as pd

from bench.contenders.registry import known_pose_springs
from report.figures.contact.springs import percent
from report.figures.kit.page import Run
from report.figures.kit.tables import Table

WAYS = Table(
    "Force and moment | Potential | Work | Work, K = kI | Way, median:.2f | Way, most:.2f | Moves apart [m]:.2f"
)


def rows(run: Run) -> pd.DataFrame:
    """Return the run's rows, words as text, springs without a potential first."""
    found = run.rows("pose-springs")
    if found.empty:
        return found
    return found.astype(dict.fromkeys(("spring", "potential"), str)).sort_values(["potential", "spring"], kind="stable")


def facts(run: Run) -> dict:
    """Work and way of what goes by a screw: the one whose way is bent most."""
    found = rows(run)
    if found.empty:
        return dict.fromkeys(("screw_work", "screw_way", "apart"))
    screw = found.loc[found["way_most"].idxmax()]
    return {
        "screw_work": percent(screw["work_share_isotropic"]),
        "screw_way": f"{screw['way_most']:.2g} (never more than π/2) ",
        "apart": f"{100.0 * found['apart_m'].max():.0f} cm",
    }


def tables(run: Run) -> dict:
    """A row a spring."""
    known = known_pose_springs()
    return {
        "ways": WAYS(
            (
                f"${known[one.spring].formula}$" if one.spring in known else one.spring,
                one.potential,
                percent(one.work_share),
                percent(one.work_share_isotropic),
                one.way_median,
                one.way_most,
                one.apart_m,
            )
            for one in rows(run).itertuples()
        )
    }
