"""Postures brought to the Z-Y-X pole decade by decade: how the condition numbers of J and of every J_E grow."""

from __future__ import annotations

import pandas as pd

from bench.contenders.registry import papers_coordinates
from report.figures.arms import arm_looks
from report.figures.kit import style
from report.figures.kit.inline import responsive_picture

PAPERS = papers_coordinates().name
WAY = r"^(?P<family>.+)-1e-(?P<k>\d+)$"
FARTHEST = 12


def ways(rows: pd.DataFrame) -> pd.DataFrame:
    """The poses at 10^-k from the pole with their family and k; those on the pole itself left out."""
    parts = rows["pose_id"].astype(str).str.extract(WAY)
    kept = rows.assign(family=parts["family"], k=pd.to_numeric(parts["k"]))
    return kept[kept["k"].notna()].astype({"k": int})


@responsive_picture
def growth(rows: pd.DataFrame, *, narrow=False):
    """Left: J and the Euler Jacobian of each arm; right: every coordinates' Jacobian, all arms. Medians and extremes.

    Args:
        rows: pose set `pole`, every representation.
    """
    found = ways(rows)
    figure, (left, right) = style.beside(2, 3.9, 7.4, narrow, sharey=True)
    papers = found[found["representation"] == PAPERS]
    for arm in arm_looks.arms(papers):
        own, look = papers[papers["arm"] == arm], arm_looks.look(arm)
        _band(left, own, "condition_analytic", look, f"$J_E$, {arm_looks.title(arm)}")
    _band(left, papers, "condition", style.Look(style.MUTED, "", style.SOLID), "$J$, all arms")
    for name in found["representation"].cat.categories:
        _band(
            right,
            found[found["representation"] == name],
            "condition_analytic",
            style.look_of_coordinates(name),
            arm_looks.short_title(name),
        )
    for axes in (left, right):
        axes.set(xscale="log", yscale="log", xlabel=r"Distance to $\beta = \pm\pi/2$ [rad]")
        axes.invert_xaxis()
        axes.set_xticks([10.0**-k for k in range(1, FARTHEST + 1, 3)])
        axes.minorticks_off()
        axes.legend(loc="upper left", fontsize=8.5, handlelength=2.2)
    left.set_ylabel("Condition number")
    left.set_title("Z-Y-X angles, by arm", fontweight="normal")
    right.set_title("By coordinates, all arms", fontweight="normal")
    right.set_ylim(1, 1e20)
    if narrow:
        right.set_ylabel("Condition number")
    last = found[found["k"] == found["k"].max()]
    words = "; ".join(
        f"{name} {own['condition_analytic'].median():.1e}"
        for name, own in last.groupby("representation", observed=True)
    )
    return figure, (
        f"Condition numbers against the distance to the Z-Y-X pole, both logarithmic. J stays at "
        f"{papers['condition'].min():.1f} to {papers['condition'].max():.1f}. At 1e-{found['k'].max()} the medians of "
        f"J_E are: {words}."
    )


def _band(axes, rows: pd.DataFrame, column: str, look: style.Look, label: str) -> None:
    """Median over families against distance, and the range in a lighter shade."""
    at = rows.groupby("k", observed=True)[column].agg(["min", "median", "max"])
    x = [10.0**-k for k in at.index]
    axes.fill_between(x, at["min"], at["max"], color=look.colour, alpha=0.18, linewidth=0)
    axes.plot(x, at["median"], color=look.colour, linestyle=look.line, marker=look.marker, markersize=3.5, label=label)
