"""What the page on arms shows of Jacobians: how well J and the Euler Jacobian are conditioned, and the film (3.1)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.colors import LogNorm
from matplotlib.lines import Line2D

from bench.findings.claims.euler_jacobian import WELL_CONDITIONED
from bench.law.contenders.registry import papers_coordinates
from report.figures.arms.arm_rows import name_arm, order_arms
from report.figures.kit import html, media, style
from report.figures.kit.inline import Drawing, responsive_picture
from report.figures.kit.page import Run, in_run
from report.figures.kit.spelling import power

PAPERS = papers_coordinates().name
LOST = 1e12
"""A condition number beyond which the rest is rounding: what a double holds, less four digits."""
BAD = 100.0
"""Condition number (metres, radians) from which on a Jacobian is called bad: twice what the claims allow."""
NEAR = 0.1
"""Margin of the coordinates below which a pose counts as near their singularity; of Z-Y-X angles 5.7 deg of beta."""

LEAST, MOST, HIGHEST = 6.0, 1e3, 1e18
KINEMATIC, OF_COORDINATES = "#d55e00", "#56b4e9"
DEGREES = 90
FIRST_EXAMPLE = {"pose_set": "named", "arm": "puma560", "pose_id": "qn"}
FILM = (
    "The same two motions side by side: the Euler Jacobian throws the arm about, the geometric one turns the tool in "
    "place."
)


def papers(run: Run, **words: str) -> pd.DataFrame:
    """Poses seen in the paper's coordinates."""
    return run.rows("poses", representation=PAPERS, **words)


def facts(run: Run) -> dict:
    """Return the first example, the poses that J_E spoils, and the film."""
    of_poses = {
        "first": lambda: describe_first(papers(run, **FIRST_EXAMPLE)),
        "spoilt": lambda: count_spoilt(papers(run, pose_set="random")),
    }
    return describe_film() | {key: in_run(say) for key, say in of_poses.items()}


def figures(run: Run) -> dict:
    """Draw the maps of two joints, and the film."""
    return {
        "condition-maps": in_run(lambda: maps(papers(run, pose_set="slice"))),
        "pole-loop": media.loop(FILM),
    }


def describe_first(rows: pd.DataFrame) -> str:
    """Return both condition numbers and the pitch of a pose in words."""
    at = rows.iloc[0]
    of_angles = float(at["condition_analytic"])
    number = html.MISSING if math.isnan(of_angles) else power(of_angles) if of_angles > LOST else f"{of_angles:.1f}"
    return (
        f"has a Jacobian with condition number {at['condition']:.1f}; in Z-Y-X angles it is {number}, for its tool "
        f"stands at β = {math.degrees(at['beta']):.0f}°, on the pole"
    )


def count_spoilt(rows: pd.DataFrame) -> str:
    """Return the least and greatest share of poses with a good J that J_E of Z-Y-X angles makes bad, in words."""
    fine = rows[rows["condition"] <= WELL_CONDITIONED]
    by = 100.0 * (fine["condition_analytic"] > BAD).groupby(fine["arm"].astype(str)).mean()
    return (
        f"Of the poses where J is in good condition (at most {WELL_CONDITIONED:g}), Z-Y-X angles spoil {by.min():.1f} "
        f"to {by.max():.1f} % (a condition number of J_E beyond {BAD:g})"
    )


def describe_film() -> dict[str, str]:
    """Return the arm of the film, how much torque both controllers ask for, and how long a way one goes."""
    about = media.facts()
    euler, geometric = about["episodes"]
    return {
        "film_arm": name_arm(about["arm"]),
        "film_ratio": f"{euler['peak_torque_ratio']:.0f}",
        "film_ratio_geometric": f"{geometric['peak_torque_ratio']:.2f}",
        "film_path": f"{euler['path_ratio']:.1f}",
    }


class Grid:
    """One arm's slice as matrices: a column for each angle of the first joint, a row for each of the second."""

    def __init__(self, rows: pd.DataFrame):
        parts = rows["pose_id"].astype(str).str.extract(r"^q(\d)-q(\d)-(\d+)-(\d+)$").astype(int)
        self.first, self.second = (int(parts[i].iloc[0]) for i in (0, 1))
        place, self.side = (parts[2].to_numpy(), parts[3].to_numpy()), int(parts[3].max()) + 1
        self.condition, self.condition_analytic, self.margin = (
            self.matrix(place, rows[name]) for name in ("condition", "condition_analytic", "margin")
        )
        self.y, self.x = (np.degrees(np.sort(rows[f"q_{joint}"].unique())) for joint in (self.second, self.first))

    def matrix(self, place: Any, values: pd.Series) -> np.ndarray:
        """Return the values at their places; what is infinite or beyond stands at HIGHEST."""
        found = np.full((self.side, self.side), np.nan)
        found[place] = values.fillna(HIGHEST).clip(upper=HIGHEST)
        return found

    def describe(self) -> str:
        """Return in words how much of the slice is near which singularity."""
        arms = self.condition > BAD
        added = (self.condition_analytic > BAD) & ~arms
        where = f"joints {self.first} and {self.second}, {self.side} by {self.side} poses"
        return f"{where}: J is beyond {BAD:g} at {arms.mean():.1%}, J_E at {added.mean():.1%} more."


@responsive_picture
def maps(rows: pd.DataFrame, *, narrow: bool = False) -> Drawing:
    """Return a row of two maps for each arm; contours say which singularity is the arm's and which the coordinates'."""
    names = order_arms(rows)
    height = (1.95 if narrow else 2.4) * len(names) + 1.0
    figure, grid = style.panels(len(names), 2, height=height, narrow=narrow, squeeze=False)
    said = []
    for name, pair in zip(names, grid, strict=True):
        own = Grid(rows[rows["arm"] == name])
        for axes, column, letter in zip(pair, ("condition", "condition_analytic"), ("$J$", "$J_E$"), strict=True):
            image = draw_map(axes, own, column)
            axes.set_title(f"{name}: {letter}", fontweight="normal")
        pair[0].set_ylabel(f"$q_{own.second}$ [deg]")
        said.append(f"{name_arm(name)}, {own.describe()}")
    bar = figure.colorbar(image, ax=list(grid.flat), location="top", shrink=0.6, aspect=30)
    bar.set_label("Condition number [metres, radians]")
    bar.set_ticks([10, 30, 100, 300, 1000], labels=["10", "30", "100", "300", "≥ 1000"])
    bar.minorticks_off()
    keys = [
        Line2D([], [], color=KINEMATIC, label=f"cond $J$ > {BAD:g}: the arm's"),
        Line2D([], [], color=OF_COORDINATES, linestyle="--", label=rf"$\cos\beta$ < {NEAR:g}: the coordinates'"),
    ]
    figure.legend(handles=keys, loc="outside lower center", ncols=1 if narrow else 2)
    return figure, f"Condition numbers of J and J_E over two joints, one row an arm. {' '.join(said)}"


def draw_map(axes: Any, own: Grid, column: str) -> Any:
    """Draw one map with its contours."""
    half = [(axis[1] - axis[0]) / 2 for axis in (own.x, own.y)]
    edges = own.x[0] - half[0], own.x[-1] + half[0], own.y[0] - half[1], own.y[-1] + half[1]
    values = np.clip(getattr(own, column), LEAST, MOST * 10)
    look = {"origin": "lower", "aspect": "auto", "norm": LogNorm(LEAST, MOST), "interpolation": "none"}
    image = axes.imshow(values, extent=edges, **look)
    for level, contoured, colour, line in (
        (np.log10(BAD), np.log10(own.condition), KINEMATIC, "-"),
        (NEAR, own.margin, OF_COORDINATES, (0, (4, 2))),
    ):
        if contoured.min() < level < contoured.max():
            axes.contour(own.x, own.y, contoured, levels=[level], colors=[colour], linestyles=[line], linewidths=1.6)
    axes.set_xlabel(f"$q_{own.first}$ [deg]", labelpad=1)
    for axis, (low, high) in ((axes.xaxis, edges[:2]), (axes.yaxis, edges[2:])):
        step = DEGREES if high - low < 400 else 2 * DEGREES
        axis.set_ticks(np.arange(np.ceil(low / step) * step, high + 1e-9, step))
    axes.grid(visible=False)
    return image
