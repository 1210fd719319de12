"""The map of a law's failures on its card.

The ball of rotation vectors is cut open along a meridian and turned flat: height is the z component, distance
from the axis the rest. The rim is the 180° rotations, where opposite points are one orientation.
"""

from __future__ import annotations

import math

import numpy as np
import pandas as pd
from matplotlib.lines import Line2D

from report.figures.kit import style
from report.figures.kit.dots import dots
from report.figures.kit.html import number
from report.figures.kit.inline import Drawing, responsive_picture

AT_REST_TO_IDENTITY = ("uniform", "box", "half-turn", "poles", "wraps")
"""Start sets in which only the orientation varies: at rest, goal identity."""
NEAR_RIM_RAD = 1e-9
WIDTH_IN = 3.15
MOST_SETTLED = 800
"""Settled starts drawn, the first of an evenly spread sequence: they are the ground, and a page is not made of dots."""


def at_rest(episodes: pd.DataFrame) -> pd.DataFrame:
    """Return the rows that the map shows: one point an orientation."""
    return episodes[episodes["start_set"].isin(AT_REST_TO_IDENTITY)]


def flat(rows: pd.DataFrame) -> np.ndarray:
    """Return (distance from the z axis, height) of each rotation vector [rad]; 180° rotations on both sides."""
    vector = rows[["quat_x", "quat_y", "quat_z"]].to_numpy() * np.where(rows["quat_w"] < 0.0, -1.0, 1.0)[:, None]
    length = np.linalg.norm(vector, axis=1)
    angle = rows["angle0_rad"].to_numpy()
    vector = vector * (angle / np.where(length > 0.0, length, 1.0))[:, None]
    points = np.column_stack((np.hypot(vector[:, 0], vector[:, 1]), vector[:, 2]))
    on_rim = points[angle > math.pi - NEAR_RIM_RAD]
    return np.vstack((points, on_rim * (1.0, -1.0)))


@responsive_picture
def card_map(episodes: pd.DataFrame, title: str) -> Drawing:
    """Outcomes of one law over orientations at rest."""
    figure, axes = style.panels(height=3.1, narrow=True)
    figure.set_size_inches(WIDTH_IN, 3.1)
    rows = at_rest(episodes)
    rim = np.linspace(-math.pi / 2, math.pi / 2, 181)
    axes.plot(math.pi * np.cos(rim), math.pi * np.sin(rim), color=style.MUTED, linewidth=0.8)
    axes.plot([0, 0], [-math.pi, math.pi], color=style.MUTED, linewidth=0.8)
    handles, words = [], []
    for outcome, (colour, marker) in style.OUTCOMES.items():
        chosen = rows[rows["outcome"] == outcome]
        if not len(chosen):
            continue
        sampled = chosen[chosen["start_set"] == "uniform"]
        if outcome == "settled":
            sampled = sampled.iloc[:MOST_SETTLED]
        x, y = flat(sampled).T
        dots(axes, x, y, colour, size=1.4 if outcome == "settled" else 2.0)
        directed = chosen[chosen["start_set"] != "uniform"]
        if outcome != "settled" and len(directed):
            x, y = flat(directed).T
            axes.plot(x, y, marker, color=colour, markersize=4.2, markeredgewidth=0.5, markeredgecolor=style.PAPER)
        look: dict = {"markeredgecolor": style.PAPER, "markeredgewidth": 0.4, "markersize": 6}
        handles.append(Line2D([], [], linestyle="none", marker=marker, color=colour, **look))
        words.append(f"{outcome} {number(len(chosen))}")
    axes.set(xlim=(-0.08, 3.3), ylim=(-3.3, 3.3), aspect="equal")
    axes.set_xticks([0, math.pi / 2, math.pi], ["0", "90°", "180°"])
    axes.set_yticks([-math.pi, 0, math.pi], ["180°", "0", "180°"])
    axes.set_xlabel(r"about $x, y$", labelpad=1)
    axes.set_ylabel(r"about $z$", labelpad=-6)
    axes.grid(visible=False)
    axes.spines[["left", "bottom"]].set_visible(False)
    axes.legend(handles, words, loc="center left", bbox_to_anchor=(1.0, 0.5), handlelength=1.0, labelspacing=0.7)
    counts = ", ".join(words)
    return figure, f"{title}: outcomes of {number(len(rows))} starts at rest over the ball of rotations: {counts}."
