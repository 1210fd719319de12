"""Two derivations of one matrix: the gaps between (3.3), (3.5) and differences of the kinematics, by the margin."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from bench.findings.claims.euler_jacobian import DIFFERENCED, EPS, NEAR, ROUNDINGS
from report.figures.arms import arm_poses
from report.figures.kit import style
from report.figures.kit.inline import responsive_picture

LEAST_GAP = 1e-17
PER_DECADE = 2
GAPS = {
    "derivation_gap": ("(3.3) against (3.5)", EPS),
    "difference_gap": ("(3.3) against central differences", DIFFERENCED),
}


def largest(rows: pd.DataFrame, column: str) -> pd.Series:
    """Largest gap in each bin of the margin, by the bin's middle; empty bins left out."""
    kept = rows[rows[column].notna() & (rows["margin"] > 0)]
    bins = np.floor(np.log10(kept["margin"].astype(float)) * PER_DECADE)
    by = kept.groupby(bins)[column].max()
    by.index = 10.0 ** ((by.index + 0.5) / PER_DECADE)
    return by.clip(lower=LEAST_GAP)


@responsive_picture
def derivations(rows: pd.DataFrame, *, narrow=False):
    """Largest gap against the margin of Z-Y-X angles, a panel for each comparison; dashed, what claim C19 allows.

    Args:
        rows: every pose, Z-Y-X angles.
    """
    figure, grid = style.beside(2, 3.5, 6.6, narrow, sharey=True)
    margins = np.array([1e-12, 1.0])
    for axes, (column, (title, unit)) in zip(grid, GAPS.items(), strict=True):
        for arm in arm_poses.arms(rows):
            look, by = arm_poses.look(arm), largest(rows[rows["arm"] == arm], column)
            marks = {"color": look.colour, "marker": look.marker, "linestyle": look.line, "linewidth": 1.1}
            axes.plot(by.index, by.to_numpy(), label=arm_poses.title(arm), **marks)
        axes.plot(margins, ROUNDINGS * unit / margins, color=style.MUTED, linestyle=(0, (4, 3)), linewidth=1.0)
        axes.axvspan(margins[0], NEAR, color=style.MUTED, alpha=0.12, linewidth=0)
        axes.set(xscale="log", yscale="log", xlabel=r"Margin $\cos\beta$", xlim=(margins[0], 1.5))
        axes.set_title(title, fontweight="normal")
        axes.minorticks_off()
    grid[0].set(ylabel="Largest relative gap", ylim=(1e-17, 10.0))
    if narrow:
        grid[1].set_ylabel("Largest relative gap")
    figure.legend(*grid[0].get_legend_handles_labels(), loc="outside upper left", ncols=2 if narrow else 4)
    found = gaps(rows)
    return figure, (
        f"Gaps between derivations of J_E against cos(beta), logarithmic: at most {found['derived']:.1f} "
        f"eps/cos(beta) between the two derivations and {found['measured']:.1f} eps^(2/3)/cos(beta) to differences."
    )


def gaps(rows: pd.DataFrame) -> dict[str, float]:
    """Both gaps and the determinant's where the margin is NEAR or more, in the units of what rounding leaves."""
    near = rows[rows["margin"] >= NEAR]
    at = {
        "derived": near["derivation_gap"] * near["margin"] / EPS,
        "measured": near["difference_gap"] * near["margin"] / DIFFERENCED,
        "determinants": near["det_gap"] * near["margin"] / EPS,
    }
    return {name: float(one.max()) if one.notna().any() else math.nan for name, one in at.items()}
