"""Starts whose turn passes the pole of Z-Y-X angles: (2.2) with a law on R beside (3.7), arm by arm."""

from __future__ import annotations

import pandas as pd

from report.figures.arms import arm_rows
from report.figures.kit import html, style
from report.figures.kit.inline import Drawing, responsive_picture

MISSES = r"-(exact|k\d+)$"
HAMMERED = 10.0
"""Peak torque over that of the law on R from the same start, as in claim C20: beyond it something hammers the arm."""


def decade(start_ids: pd.Series) -> pd.Series:
    """k of a start that misses the pole by 10^-k rad; one more than the largest for exact ones."""
    words = start_ids.str.extract(MISSES)[0]
    numbers = pd.to_numeric(words.str.removeprefix("k"), errors="coerce")
    beyond = 1 + (int(numbers.max()) if numbers.notna().any() else 0)
    return numbers.fillna(beyond).astype(int)


@responsive_picture
def pole(rows: pd.DataFrame, narrow: bool) -> Drawing:
    """Peak torque over rated against how near to the pole the turn passes; a cross for an episode that fails.

    Args:
        rows: of `arm_rows.episodes`, by the standard inverse.
    """
    starts = rows[(rows["start_set"] == "pole") & rows["controller"].isin(arm_rows.PAPERS_TWO)]
    starts = starts.assign(k=decade(starts["start_id"]))
    names = arm_rows.order_arms(starts)
    figure, grid = style.grid(len(names), 1.9, 1.75, narrow, top=0.8, sharey=True)
    said = []
    for axes, arm in zip(grid.flat, names, strict=False):
        for step, controller in enumerate(arm_rows.PAPERS_TWO):
            own = starts[(starts["arm"] == arm) & (starts["controller"] == controller)]
            look, good = style.look(controller), arm_rows.settled(own)
            for chosen, marker, size in ((good, look.marker, 4), (~good, "x", 6)):
                place, torque = own["k"][chosen] + 0.16 * (2 * step - 1), own.loc[chosen, "peak_torque_ratio"]
                axes.plot(place, torque, marker, markersize=size, color=look.colour)
            said.append(
                f"{arm}, {arm_rows.title(controller)} fails {int((~good).sum())} of {len(own)}, median peak torque "
                f"{html.number(own['peak_torque_ratio'].median())} times the rated one"
            )
        axes.axhline(1.0, color=style.INK, linewidth=0.9, linestyle=style.DASHED)
        axes.set(title=arm, yscale="log")
        axes.minorticks_off()
    steps = sorted(set(starts["k"]))
    for axes in grid[-1]:
        axes.set_xticks(steps, [*(f"$10^{{-{k}}}$" for k in steps[:-1]), "0"])
        axes.set_xlabel("passes the pole at [rad]")
    for controller in arm_rows.PAPERS_TWO:
        look = style.look(controller)
        axes.plot([], [], look.marker, color=look.colour, label=arm_rows.title(controller), markersize=5)
    axes.plot([], [], "x", color=style.INK, label="fails", markersize=6)
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=1 if narrow else 3)
    style.label_rows(figure, "peak torque over rated")
    return figure, f"Turns that pass the pole. {'; '.join(said)}."


def side_by_side(rows: pd.DataFrame) -> pd.DataFrame:
    """Pole starts by (3.7) and by (2.2) with the law on R, joined: a row a start."""
    starts = rows[rows["start_set"] == "pole"]
    columns = ["arm", "start_id", "outcome", "peak_torque_ratio"]
    own, other = (starts.loc[starts["controller"] == name, columns] for name in reversed(arm_rows.PAPERS_TWO))
    both = own.merge(other, on=["arm", "start_id"], suffixes=("", "_matrix"))
    return both.assign(
        fails=both["outcome"] != "settled",
        fails_matrix=both["outcome_matrix"] != "settled",
        harder=both["peak_torque_ratio"] / both["peak_torque_ratio_matrix"],
    )
