"""Condition numbers over a slice of joint space: J and the Euler Jacobian side by side, their singularities apart."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.colors import LogNorm
from matplotlib.lines import Line2D

from report.figures.arms.arm_looks import arms, title
from report.figures.kit import style
from report.figures.kit.inline import responsive_picture

BAD = 100.0
"""Condition number (metres, radians) from which on maps and tables call a Jacobian bad: twice what the claims allow."""

NEAR = 0.1
"""Margin of the coordinates below which a pose counts as near their singularity; of Z-Y-X angles 5.7 deg of beta."""

LEAST, MOST, HIGHEST = 6.0, 1e3, 1e18
KINEMATIC, OF_COORDINATES = "#d55e00", "#56b4e9"
DEGREES = 90


class Grid:
    """One arm's slice as matrices: a column for each angle of the first joint, a row for each of the second."""

    def __init__(self, rows: pd.DataFrame):
        parts = rows["pose_id"].astype(str).str.extract(r"^q(\d)-q(\d)-(\d+)-(\d+)$").astype(int)
        self.first, self.second = (int(parts[i].iloc[0]) for i in (0, 1))
        place, side = (parts[2].to_numpy(), parts[3].to_numpy()), int(parts[3].max()) + 1
        self.side = side
        self.condition, self.condition_analytic, self.margin = (
            self.matrix(place, rows[name]) for name in ("condition", "condition_analytic", "margin")
        )
        self.y, self.x = (np.degrees(np.sort(rows[f"q_{joint}"].unique())) for joint in (self.second, self.first))

    def matrix(self, place, values: pd.Series) -> np.ndarray:
        """Return the values at their places; what is infinite or beyond stands at HIGHEST."""
        found = np.full((self.side, self.side), np.nan)
        found[place] = values.fillna(HIGHEST).clip(upper=HIGHEST)
        return found

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """Edges of the outermost cells [deg]."""
        half = [(axis[1] - axis[0]) / 2 if len(axis) > 1 else 1.0 for axis in (self.x, self.y)]
        return self.x[0] - half[0], self.x[-1] + half[0], self.y[0] - half[1], self.y[-1] + half[1]


@responsive_picture
def maps(rows: pd.DataFrame, *, narrow=False):
    """Return a row of two maps for each arm; contours say which singularity is the arm's and which the coordinates'."""
    names = arms(rows)
    height = (1.95 if narrow else 2.4) * len(names) + 1.0
    figure, grid = style.panels(len(names), 2, height=height, narrow=narrow, squeeze=False)
    words, image = [], None
    for name, pair in zip(names, grid, strict=True):
        own = Grid(rows[rows["arm"] == name])
        for axes, column in zip(pair, ("condition", "condition_analytic"), strict=True):
            image = _map(axes, own, column)
        pair[0].set_ylabel(f"{'' if narrow else title(name) + chr(10)}$q_{own.second}$ [deg]")
        if narrow:
            pair[0].set_title(title(name), fontweight="normal")
        words.append(said(name, own))
    for axes, letter in zip(grid[0], ("$J$", "$J_E$"), strict=True):
        above = f"{axes.get_title(loc='left')}\n" if narrow and axes is grid[0][0] else ""
        axes.set_title(f"{above}{letter}" if narrow else f"condition number of {letter}", fontweight="normal")
    if narrow:
        grid[0][0].set_title(f"{title(names[0])}: $J$", fontweight="normal")
    bar = figure.colorbar(image, ax=list(grid.flat), location="top", shrink=0.6, aspect=30)
    bar.set_label("Condition number [metres, radians]")
    ticks = [10, 30, 100, 300, 1000]
    bar.set_ticks(ticks, labels=[*map(str, ticks[:-1]), f"≥ {ticks[-1]}"])
    bar.minorticks_off()
    keys = [
        Line2D([], [], color=KINEMATIC, label=f"cond $J$ > {BAD:g}: the arm's"),
        Line2D([], [], color=OF_COORDINATES, linestyle="--", label=rf"$\cos\beta$ < {NEAR:g}: the coordinates'"),
    ]
    figure.legend(handles=keys, loc="outside lower center", ncols=1 if narrow else 2)
    return figure, f"Condition numbers of J and J_E over two joints, one row an arm. {' '.join(words)}"


def _map(axes, own: Grid, column: str):
    """One map with its contours."""
    values = np.clip(getattr(own, column), LEAST, MOST * 10)
    image = axes.imshow(
        values, extent=own.extent, origin="lower", aspect="auto", norm=LogNorm(LEAST, MOST), interpolation="none"
    )
    for level, values, colour, line in (
        (np.log10(BAD), np.log10(own.condition), KINEMATIC, "-"),
        (NEAR, own.margin, OF_COORDINATES, (0, (4, 2))),
    ):
        if values.min() < level < values.max():
            axes.contour(own.x, own.y, values, levels=[level], colors=[colour], linestyles=[line], linewidths=1.6)
    axes.set_xlabel(f"$q_{own.first}$ [deg]", labelpad=1)
    for axis, edges in ((axes.xaxis, own.extent[:2]), (axes.yaxis, own.extent[2:])):
        step = DEGREES if edges[1] - edges[0] < 400 else 2 * DEGREES
        axis.set_ticks(np.arange(np.ceil(edges[0] / step) * step, edges[1] + 1e-9, step))
    axes.grid(visible=False)
    return image


def said(name: str, own: Grid) -> str:
    """Return an arm's maps in words."""
    kinematic, near = own.condition > BAD, own.margin < NEAR
    added = (own.condition_analytic > BAD) & ~kinematic
    return (
        f"{title(name)}, joints {own.first} and {own.second}, {own.side} by {own.side} poses: J is beyond "
        f"{BAD:g} at {kinematic.mean():.1%}, J_E at {added.mean():.1%} more; the coordinates are near their "
        f"singularity at {near.mean():.1%}."
    )
