"""Rotational springs with a stiffness matrix: which of them are springs at all."""

from __future__ import annotations

import pandas as pd

from bench.contenders.registry import known_springs
from report.figures.kit import html
from report.figures.kit.page import Run
from report.figures.kit.tables import Table

WORK = Table("Moment | Axes | Potential | Stiffness felt | Work | Work, K = kI | Rests at 180° | Balance")


def rows(run: Run) -> pd.DataFrame:
    """Return the run's rows, words as text, springs without a potential first."""
    found = run.rows("springs")
    if found.empty:
        return found
    return found.astype(dict.fromkeys(("spring", "frame", "potential"), str)).sort_values(
        ["potential", "spring"], kind="stable"
    )


def facts(run: Run) -> dict:
    """The most work of those with and of those without a potential."""
    found = rows(run)
    if found.empty:
        return dict.fromkeys(("loops", "worst", "rounding"))
    most = found.groupby("potential")["work_share"].max()
    return {
        "loops": int(found["loops"].max()),
        "worst": f"{100.0 * most['no']:.0f} % (the most of {int(found['loops'].max())} loops; more loops give more)",
        "rounding": f"{html.number(float('{:.0e}'.format(most['yes'])))} of it",
    }


def tables(run: Run) -> dict:
    """A row a spring and frame."""
    known = known_springs()
    return {
        "work": WORK(
            (
                f"${known[one.spring].formula}$" if one.spring in known else one.spring,
                one.frame,
                one.potential,
                f"{one.felt_least:.2g}",
                percent(one.work_share),
                percent(one.work_share_isotropic),
                f"{one.vanishes} of 3",
                html.number(float(f"{one.balance_share:.0e}")),
            )
            for one in rows(run).itertuples()
        )
    }


def percent(share: float) -> str:
    """Format as a percentage, rounding noise as 0."""
    return f"{100.0 * share:.0f} %" if share > 1e-12 else "0"
