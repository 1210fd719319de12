"""How much of a workspace each Jacobian spoils: condition numbers over poses spread evenly in the joint ranges."""

from __future__ import annotations

import numpy as np
import pandas as pd

from report.figures.arms import arm_poses
from report.figures.kit import style
from report.figures.kit.inline import responsive_picture

CEILING = 1e5
POINTS = np.logspace(np.log10(4.0), 5.0, 60)


def beyond(values: pd.Series) -> np.ndarray:
    """Share of the values above each of POINTS."""
    ordered = np.sort(arm_poses.finite(values, 1e18))
    return 1.0 - np.searchsorted(ordered, POINTS, side="right") / len(ordered)


@responsive_picture
def shares(rows: pd.DataFrame, *, narrow=False):
    """Share of random poses whose condition number is above a value, a panel an arm, a curve for each Jacobian."""
    names = arm_poses.arms(rows)
    figure, grid = style.grid(len(names), 2.45, 2.3, narrow, top=1.3 if narrow else 0.9, sharey=True)
    words = []
    for arm, axes in zip(names, grid.flat, strict=False):
        own = rows[rows["arm"] == arm]
        for name, of in own.groupby("representation", observed=True):
            look = arm_poses.look_of_coordinates(str(name))
            curve = np.where(beyond(of["condition_analytic"]) > 0, beyond(of["condition_analytic"]), np.nan)
            axes.plot(
                POINTS,
                curve,
                color=look.colour,
                linestyle=look.line,
                linewidth=1.4,
                label=arm_poses.short_title(str(name)),
            )
        once = own[own["representation"] == own["representation"].iloc[0]]
        curve = np.where(beyond(once["condition"]) > 0, beyond(once["condition"]), np.nan)
        axes.plot(POINTS, curve, color=style.INK, linewidth=2.2, label="$J$ itself")
        axes.axvline(arm_poses.BAD, color=style.MUTED, linewidth=0.9, linestyle=(0, (4, 3)))
        axes.set_title(arm_poses.title(arm), fontweight="normal")
        axes.set(xscale="log", yscale="log", xlim=(POINTS[0], CEILING))
        axes.set_yticks([1e-3, 1e-2, 1e-1, 1.0], ["0.1 %", "1 %", "10 %", "100 %"])
        axes.minorticks_off()
        papers = own[own["representation"] == arm_poses.PAPERS]
        both = (arm_poses.share(of > arm_poses.BAD) for of in (once["condition"], papers["condition_analytic"]))
        by_j, by_angles = (f"{one:.1%}" for one in both)
        title = arm_poses.title(arm)
        words.append(f"{title}: above {arm_poses.BAD:g} at {by_j} for J, {by_angles} for J_E by Z-Y-X angles")
    for axes in grid[-1]:
        axes.set_xlabel("Condition number")
    for axes in grid[:, 0]:
        axes.set_ylabel("Poses above it")
    figure.legend(*grid[0][0].get_legend_handles_labels(), loc="outside upper left", ncols=2 if narrow else 3)
    return figure, f"Share of random poses above a condition number, logarithmic. {'; '.join(words)}."
