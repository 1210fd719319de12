"""What the pages on compliance read of compliance.parquet: rows of a task, who is drawn how, and what was measured.

C, 3 x 3, is a row's rotation per moment [rad/(N m)]: C[i, j] about i per moment about j.
"""

from __future__ import annotations

import functools

import numpy as np
import pandas as pd

from bench.findings import claims
from bench.law.contenders.registry import contenders
from bench.law.control.contact_controller import PAPERS_FORM
from report.figures.claims import claims as shown
from report.figures.kit import html, style
from report.figures.kit.page import Run, in_run

CARTESIAN, EULER = "hybrid-base+inverse", "hybrid/zyx-euler+inverse"
HAND, BY_RATE = "hybrid-hand+inverse", "hybrid-rate+inverse"
PAPERS, PAPERS_EULER = "hybrid-base+transpose", "hybrid/zyx-euler+transpose"
ZYZ, UNCONVERTED = "hybrid/zyz-euler+inverse", "hybrid-unconverted/zyx-euler+inverse"
SPRINGS_OF_EULER = "impedance-coordinates/zyx-euler"

LOOKS = {
    "hybrid-base": style.Look("#0072b2", "o", style.SOLID),
    "hybrid/zyx-euler": style.Look("#d55e00", "s", style.DASHED),
    "impedance-geometric": style.Look("#009e73", "^", style.DASH_DOT),
    "impedance-coordinates/zyx-euler": style.Look("#cc79a7", "D", style.DOTTED),
}
"""The controllers that are drawn, which tables show first."""

TITLES = {
    "hybrid-base": "Cartesian",
    "hybrid-hand": "Cartesian, the hand's axes",
    "hybrid-rate": "Cartesian, turns held by rate",
    "hybrid": "Euler Jacobian",
    "hybrid-unconverted": "Moments unconverted",
}
SPRINGS, OTHER = "Impedance: ", "Analytic Jacobian"
COORDINATES = {
    "zyx-euler": "Z-Y-X",
    "zyz-euler": "Z-Y-Z",
    "xyz-euler": "X-Y-Z",
    "rotation-vector": "rotation vector",
    "mrp": "Rodrigues",
}
WORDS = ("task", "arm", "contender", "complies", "pose", "outcome", "rest", "form")

ORDERS = ("about x", "about y", "about z", "about x and y", "about y and z", "about z and x")


@functools.cache
def of_task(run: Run, task: str) -> pd.DataFrame:
    """Return rows of one task, with plain words, `way`, and the goal's angles [deg].

    way: the controller without its form, for the forms that command accelerations; the paper's keeps its name.
    """
    found = run.rows("compliance", task=task)
    found = found.assign(**{word: found[word].astype(str) for word in WORDS})
    degrees = {f"{name}_deg": np.degrees(found[name]).round(6) + 0.0 for name in ("alpha", "beta", "gamma", "tilt")}
    way = found["contender"].where(found["form"] == PAPERS_FORM, found["contender"].str.partition("+")[0])
    return found.assign(way=way, **degrees)


def verdicts(run: Run, *ids: str) -> html.Markdown | None:
    """Return these claims with their words, linked to their sections; None without rows."""
    if run.any_rows("compliance").empty:
        return None
    results = claims.Results(run.folder)
    return in_run(lambda: shown.table([claims.judge(one, results) for one in ids], "40-claims.html"))


def of(rows: pd.DataFrame, contender: str, complies: str = "") -> pd.DataFrame:
    """Rows of one controller, and of one order if it is named."""
    own = rows[rows["contender"] == contender]
    return own[own["complies"] == complies] if complies else own


def level(rows: pd.DataFrame) -> pd.DataFrame:
    """Return the rows whose goal has no alpha and no gamma, by beta."""
    return rows[(rows["alpha_deg"] == 0.0) & (rows["gamma_deg"] == 0.0)].sort_values("beta_deg", kind="stable")


def nearest(rows: pd.DataFrame, betas: tuple[float, ...]) -> list[float]:
    """Return the betas [deg] of the rows that are nearest to the given ones: grids of suites differ."""
    there = sorted(set(rows["beta_deg"]))
    return list(dict.fromkeys(min(there, key=lambda one: abs(one - beta)) for beta in betas))


def compliance(row) -> np.ndarray:
    """C of one row; NaN where the hand did not get to the end."""
    return np.array([[float(row[f"c_{i}{j}"]) for j in "xyz"] for i in "xyz"])


def wanted(rows: pd.DataFrame) -> dict[str, float]:
    """Arm -> rotation per moment [rad/(N m)] of an axis that complies: c_xx of Cartesian compliance about x."""
    return {arm: float(own["c_xx"].median()) for arm, own in of(rows, CARTESIAN, "about x").groupby("arm")}


def arms(rows: pd.DataFrame) -> list[str]:
    """Return the arms of the rows, sorted."""
    return sorted(set(rows["arm"]))


def title(way: str) -> str:
    """How a controller is called in a figure: its frame, or its coordinates."""
    law, _, coordinates = way.partition("+")[0].partition("/")
    if law.startswith("impedance-"):
        name = f"{SPRINGS}{contenders('impedances')[law.removeprefix('impedance-')].title}"
    else:
        name = OTHER if law == "hybrid" and not coordinates.endswith("euler") else TITLES.get(law, law)
    return f"{name}, {COORDINATES.get(coordinates, coordinates)}" if coordinates else name
