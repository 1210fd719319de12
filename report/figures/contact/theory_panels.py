"""Measured against theory over beta: leakage, the moment that is lost, and how unlike the stiffness is.

    leakage             tan |beta|                             two Euler axes comply, about x and y
    least yield         1 - |sin beta|                         of that at beta = 0: B B^T, its least singular value
    condition number    (1 + |sin beta|)/(1 - |sin beta|)      springs along Euler angles, B^-T B^-1

The formulas are those of `compliance_theory`.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import pandas as pd

from bench.findings.theory import compliance_theory as theory
from report.figures.contact.rows import SPRINGS_OF_EULER, arms, level, of
from report.figures.kit import style
from report.figures.kit.inline import responsive_picture

DRAWN_TO, COMPARED_TO = 89.0, 85.0
"""Degrees of |beta|. On its way the hand turns by some milliradians, and to the pole there are 17 at 89 degrees."""
MARKS = (
    {"marker": "o", "color": "#0072b2", "markersize": 7.0, "fillstyle": "none"},
    {"marker": "o", "color": "#d55e00", "markersize": 3.5},
    {"marker": "D", "color": "#009e73", "markersize": 9.0, "fillstyle": "none"},
    {"marker": "s", "color": "#cc79a7", "markersize": 11.0, "fillstyle": "none"},
)  # one within the other: arms agree
PROJECTED = {"marker": "x", "color": style.MUTED, "markersize": 5.0}


class Law(NamedTuple):
    """One panel: its words, what it predicts of |beta| [rad], and which rows measure it, by which column."""

    title: str
    formula: str
    predicted: Callable
    measured: Callable[[pd.DataFrame], pd.DataFrame]


def leakage(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows of two Euler axes that comply, and what leaks into the third."""
    own = level(rows[rows["way"] == "hybrid/zyx-euler"])
    own = own[own["complies"] == "about x and y"]
    return own.assign(value=own["leakage_ratio"])


def least_yield(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows of springs along Euler angles, and their least yield over that at beta = 0."""
    own = springs(rows)
    at_zero = own[own["beta_deg"] == 0.0].groupby("arm")["least_yield_rad_per_nm"].first()
    return own.assign(value=own["least_yield_rad_per_nm"] / own["arm"].map(at_zero).astype(float))


def condition(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows of springs along Euler angles, and the condition number of their stiffness."""
    own = springs(rows)
    return own.assign(value=own["stiffness_condition"])


def springs(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows of the impedance in Z-Y-X angles, level frames only."""
    return level(of(rows, SPRINGS_OF_EULER))


LAWS = {
    "leakage": Law("Leakage into the held axis", r"$\tan\beta$", theory.leakage, leakage),
    "least-yield": Law("Least compliance, relative", r"$1 - \sin\beta$", theory.least_yield, least_yield),
    "condition": Law(
        "Stiffness, condition number", r"$\frac{1 + \sin\beta}{1 - \sin\beta}$", theory.stiffness_condition, condition
    ),
}


def gaps(rows: pd.DataFrame) -> dict[str, float]:
    """Largest relative difference of measured and predicted, up to COMPARED_TO degrees, of each law."""
    found = {}
    for name, law in LAWS.items():
        own = law.measured(rows)
        beta = np.radians(own["beta_deg"].abs())
        near = (beta > 0.0) & (own["beta_deg"].abs() <= COMPARED_TO)
        found[name] = float((own["value"] / beta.map(law.predicted) - 1.0)[near].abs().max())
    return found


@responsive_picture
def measured_and_predicted(rows: pd.DataFrame, narrow: bool):
    """Three panels over beta: theory as a line, a mark a row.

    Args:
        rows: of wrench-probe.
    """
    names = arms(rows)
    looks = dict(zip(names, itertools.cycle(MARKS), strict=False))
    figure, panels = style.beside(3, 2.9, 7.4, narrow)
    smooth = np.linspace(0.4, DRAWN_TO, 400)
    counted = 0
    for axes, law in zip(panels, LAWS.values(), strict=True):
        axes.plot(
            smooth, [law.predicted(beta) for beta in np.radians(smooth)], color=style.INK, linewidth=1.1, zorder=1
        )
        own = law.measured(rows)
        own = own[(own["beta_deg"].abs() <= DRAWN_TO) & own["value"].notna() & (own["beta_deg"] != 0.0)]
        for (arm, form), part in own.groupby(["arm", "form"]):
            mark = PROJECTED if form == "projected" else looks[arm]
            axes.plot(part["beta_deg"].abs(), part["value"], linestyle="none", **mark)
        axes.set(yscale="log", xlim=(0, 92), xlabel="β [deg]")
        axes.set_title(law.title, fontweight="normal")
        axes.set_xticks([0, 30, 60, 90])
        axes.minorticks_off()
        axes.text(
            *((0.05, 0.06) if law is LAWS["least-yield"] else (0.05, 0.9)), law.formula, transform=axes.transAxes,
            va="bottom" if law is LAWS["least-yield"] else "top", fontsize=12,
        )  # fmt: skip
        counted += len(own)
    for arm, mark in looks.items():
        panels[0].plot([], [], linestyle="none", label=arm, **mark)
    panels[0].plot([], [], linestyle="none", label="both, by (S J)⁺", **PROJECTED)
    panels[0].plot([], [], color=style.INK, linewidth=1.1, label="theory")
    figure.legend(loc="outside lower center", ncols=2 if narrow else 4)
    words = ", ".join(f"{name} {gap:.1e}" for name, gap in gaps(rows).items())
    return figure, (
        f"Three quantities against beta, theory as a line and {counted} measured marks on it. Largest relative "
        f"difference up to {COMPARED_TO:g} degrees: {words}."
    )
