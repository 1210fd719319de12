"""Turns through and past singularities of the arm itself: what each inverse makes of them."""

from __future__ import annotations

import pandas as pd

from report.figures.arms import arm_rows
from report.figures.kit import html, style
from report.figures.kit.inline import responsive_picture

SHOWN = (arm_rows.ON_MATRIX, arm_rows.ON_ANGLES)
QUANTILES = (0.05, 0.5, 0.95)
ORDER = (
    arm_rows.STANDARD,
    "pseudo-inverse",
    "damped-least-squares",
    "damped-least-squares-variable",
    "truncated-svd",
    "dynamically-consistent",
    "transpose",
)
LEAST_MM = 1e-3


def inverses(rows: pd.DataFrame) -> list[str]:
    """Those that the rows hold, in order; what is another name for the standard one on every arm is left out."""
    there = {way.partition("+")[2] for way in rows["way"]}
    return [name for name in ORDER if name in there] + sorted(there - set(ORDER))


def of_wrist(rows: pd.DataFrame) -> pd.DataFrame:
    """Wrist starts by the two controllers."""
    return rows[(rows["start_set"] == "wrist") & rows["controller"].isin(SHOWN)]


@responsive_picture
def wrist(rows: pd.DataFrame, narrow: bool):
    """Share that settles, and how far the tool strays: a row an inverse, a mark a controller.

    Args:
        rows: of `arm_rows.episodes`.
    """
    starts = of_wrist(rows)
    names = inverses(starts)
    figure, (left, right) = style.beside(2, 0.42 * len(names) + 1.5, 6.0, narrow, sharey=True)
    said = []
    for i, name in enumerate(names):
        told = []
        for k, controller in enumerate(SHOWN):
            own = arm_rows.of(starts, controller, name)
            if own.empty:
                continue
            look, place = style.look(controller), i + 0.18 * (2 * k - 1)
            share = 100.0 * float(arm_rows.settled(own).mean())
            strayed = (1e3 * own["position_error_m"]).clip(lower=LEAST_MM).quantile(QUANTILES)
            low, middle, high = strayed
            left.plot([0.0, share], [place, place], color=look.colour, linewidth=1.2, alpha=0.6)
            left.plot(share, place, look.marker, color=look.colour, markersize=6)
            right.plot([low, high], [place, place], color=look.colour, linewidth=3.2, alpha=0.5)
            right.plot(middle, place, look.marker, color=look.colour, markersize=6)
            told.append(
                f"{arm_rows.title(controller)} settles {share:.0f} % and strays {html.number(middle)} mm in the median"
            )
        said.append(f"{arm_rows.title_of_inverse(name)}: {', '.join(told)}")
    for controller in SHOWN:
        look = style.look(controller)
        left.plot([], [], look.marker, color=look.colour, label=arm_rows.title(controller), markersize=6)
    left.set(xlabel="settles [%]", xlim=(0, 104), ylim=(len(names) - 0.5, -0.5))
    left.set_yticks(range(len(names)), [arm_rows.title_of_inverse(name).replace(", ", ",\n") for name in names])
    right.set(xscale="log", xlabel="tool strays by [mm]")
    right.minorticks_off()
    style.listed(left, right)
    figure.legend(loc="outside lower center", ncols=1 if narrow else 2)
    return figure, f"Turns through and past singularities of the arm. {'. '.join(said)}."
