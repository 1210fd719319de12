"""What turning asks of an arm: how far the tool strays from its place, and the largest torque over the rated one."""

from __future__ import annotations

import pandas as pd

from report.figures.arms import arm_rows
from report.figures.kit import html, style
from report.figures.kit.inline import responsive_picture

QUANTILES = (0.05, 0.5, 0.95)
SHOWN = (arm_rows.ON_MATRIX, arm_rows.ON_ANGLES)
LEAST_MM = 1e-3
"""Smaller position errors are drawn there: of an arm whose tool is its wrist's centre they are rounding."""


@responsive_picture
def strain(rows: pd.DataFrame, narrow: bool):
    """Median and 5 to 95 % of both, a row an arm and controller, clear starts.

    Args:
        rows: of `arm_rows.episodes`, by the standard inverse.
    """
    clear = rows[rows["start_set"] == "clear"]
    names = arm_rows.arms(clear)
    figure, (left, right) = style.beside(2, 3.4, 6.2, narrow, sharey=True)
    said = []
    for i, arm in enumerate(names):
        told = []
        for k, controller in enumerate(SHOWN):
            own = arm_rows.of(clear[clear["arm"] == arm], controller)
            if own.empty:
                continue
            look, place = style.look(controller), i + 0.2 * (2 * k - 1)
            strayed = (1e3 * own["position_error_m"]).clip(lower=LEAST_MM).quantile(QUANTILES)
            torque = own["peak_torque_ratio"].quantile(QUANTILES)
            for axes, (low, middle, high) in ((left, strayed), (right, torque)):
                axes.plot([low, high], [place, place], color=look.colour, linewidth=3.2, alpha=0.5)
                axes.plot(middle, place, look.marker, color=look.colour, markersize=6.5)
            told.append(
                f"{arm_rows.title(controller)} strays {html.number(strayed[0.5])} mm and asks for "
                f"{html.number(torque[0.5])} times the rated torque"
            )
        said.append(f"{arm}: {', '.join(told)}")
    for controller in SHOWN:
        look = style.look(controller)
        left.plot([], [], look.marker, color=look.colour, label=arm_rows.title(controller), markersize=6)
    right.axvline(1.0, color=style.INK, linewidth=0.9, linestyle=style.DASHED)
    right.text(1.0, -0.62, " rated", fontsize=9, va="center")
    left.set(xscale="log", xlabel="tool strays by [mm]", ylim=(len(names) - 0.4, -0.85))
    left.set_yticks(range(len(names)), names)
    right.set(xscale="log", xlabel="peak torque over rated")
    style.listed(left, right)
    for axes in (left, right):
        axes.minorticks_off()
    figure.legend(loc="outside lower center", ncols=1 if narrow else 2)
    return figure, f"Medians over clear starts. {'; '.join(said)}."
