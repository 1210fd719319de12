"""Springs of a pose and of a rotation: which of them are springs at all, and which path they make a hand take."""

from __future__ import annotations

import pandas as pd

from bench.law.contenders.registry import contenders
from report.figures.kit import html
from report.figures.kit.page import Run, in_run
from report.figures.kit.tables import Table

WORK = Table("Moment | Axes | Potential | Stiffness felt | Work | Work, K = kI | Rests at 180° | Balance")
WORDS = ("spring", "potential", "frame")


def read_rows(run: Run, name: str) -> pd.DataFrame:
    """Return a table of the run with its words as text, springs without a potential first."""
    found = run.rows(name)
    words = [word for word in WORDS if word in found]
    return found.astype(dict.fromkeys(words, str)).sort_values(["potential", "spring"], kind="stable")


def facts(run: Run) -> dict:
    """Return the most work with and without a potential."""
    found = read_rows(run, "springs")
    most = found.groupby("potential")["work_share"].max()
    loops = int(found["loops"].max())
    return {
        "loops": loops,
        "worst": f"{100.0 * most['no']:.0f} % (the most of {loops} loops; more loops give more)",
        "rounding": f"{html.number(float('{:.0e}'.format(most['yes'])))} of it",
        **(in_run(lambda: of_poses(read_rows(run, "pose-springs"))) or {}),
    }


def of_poses(found: pd.DataFrame) -> dict:
    """Return work and path of the spring of a pose whose path is bent most."""
    screw = found.loc[found["way_most"].idxmax()]
    return {
        "screw_work": write_percent(screw["work_share_isotropic"]),
        "screw_way": f"{screw['way_most']:.2g} (never more than π/2) ",
    }


def tables(run: Run) -> dict:
    """Return a row a rotational spring and frame."""
    work = (
        (
            write_formula(one.spring),
            one.frame,
            one.potential,
            f"{one.felt_least:.2g}",
            write_percent(one.work_share),
            write_percent(one.work_share_isotropic),
            f"{one.vanishes} of 3",
            html.number(float(f"{one.balance_share:.0e}")),
        )
        for one in read_rows(run, "springs").itertuples()
    )
    return {"work": WORK(work)}


def write_formula(name: str) -> str:
    """Return the formula of a spring; its name if it is not here any more."""
    known = contenders("springs")
    return f"${known[name].formula}$" if name in known else name


def write_percent(share: float) -> str:
    """Return a share in per cent, and rounding noise as 0."""
    return f"{100.0 * share:.0f} %" if share > 1e-12 else "0"
