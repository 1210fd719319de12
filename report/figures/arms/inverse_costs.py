"""What each inverse of a Jacobian costs, and what it buys on turns through the arm's own singularities."""

from __future__ import annotations

import pandas as pd

from report.figures.arms import arm_rows
from report.figures.kit import style
from report.figures.kit.inline import responsive_picture

JOINTS = {6: style.Look("#0072b2", "o", style.SOLID), 7: style.Look("#d55e00", "s", style.DASHED)}
CONTROLLER = arm_rows.ON_MATRIX


def invert(rows: pd.DataFrame) -> pd.DataFrame:
    """A row an inverse, the cheapest first: flops of the stage `invert` by the number of joints."""
    own = rows[(rows["controller"] == CONTROLLER) & (rows["stage"] == "invert")]
    table = own.pivot_table(index="inverse", columns="joints", values="flops", sort=False)
    return table.loc[table.min(axis=1).sort_values(kind="stable").index]


@responsive_picture
def inverses(rows: pd.DataFrame, *, narrow=False):
    """Flops of each inverse, logarithmic; and the line of all the rest of the tick."""
    table = invert(rows)
    figure, axes = style.panels(height=1.1 + (0.42 if narrow else 0.34) * len(table), narrow=narrow)
    rest = rows[(rows["controller"] == CONTROLLER) & ~rows["stage"].isin(["total", "invert"])]
    said = []
    for joints, look in JOINTS.items():
        if joints not in table:
            continue
        marks = {"color": look.colour, "marker": look.marker, "linestyle": "none", "markersize": 7}
        axes.plot(table[joints], range(len(table)), label=f"{joints} joints", **marks)
        own = rest[rest["joints"] == joints]
        others = own.groupby("contender")["flops"].sum().max()
        axes.axvline(others, color=look.colour, linewidth=1.0, linestyle=look.line, label=f"all else, {joints} joints")
        said.append(
            f"{joints} joints: " + ", ".join(f"{name} {flops:.0f}" for name, flops in table[joints].dropna().items())
        )
    axes.set_yticks(
        range(len(table)),
        [
            arm_rows.title_of_inverse(name).replace(" least ", "\nleast ")
            if narrow
            else arm_rows.title_of_inverse(name)
            for name in table.index
        ],
    )
    axes.set(xscale="log", xlabel="Flops of one inversion a tick")
    axes.set_ylim(len(table) - 0.5, -0.5)
    axes.tick_params(axis="y", length=0)
    figure.legend(loc="outside upper left", ncols=2 if narrow else 4, columnspacing=1.2)
    return figure, f"Flops of one inversion a tick, logarithmic, by inverse. {'; '.join(said)}."
