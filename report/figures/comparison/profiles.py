"""Performance profiles: the share of starts from which a law is within a factor of the best law there.

Dolan and Moré (2002). Left, at a factor of one, stands how often a law is the best; right, how often it settles at all.
A panel is a family; every other law is in it as a thin line in grey.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from bench.tables.statistics import over_best, profile
from report.figures.comparison.cells import costs
from report.figures.kit import families, style
from report.figures.kit.inline import responsive_picture

LABELLED = 0.105
"""Least distance of two labels beside curves, as a share of the panel's height."""

FACTORS, COARSE = 97, 6
"""Points of a curve, and of how many every one is kept where it is only background: a page is not made of paths."""

REST = "#b9c3cf"
"""The laws of other panels."""

SAMPLE = (1.03, 1.17)
"""Where a label's piece of line lies, in widths of the panel."""

OTHER_LINES = (style.SOLID, style.DASHED, style.DASH_DOT, style.DOTTED, (0, (8, 2)))
"""Of laws of one panel that share a look: one regulator in several coordinates."""


@responsive_picture
def profiles(rows: pd.DataFrame, column: str, marks: tuple[float, ...], what: str, *, narrow=False):
    """A panel a family: share of starts against the factor over the best law.

    Args:
        rows: of `cells.common`. column: what is compared. marks: factors on the axis, the last its end.
        what: the column in words, "settling time" say.
    """
    table = costs(rows, column)
    factors = np.geomspace(1.0, marks[-1], FACTORS)
    shares = pd.DataFrame(profile(over_best(table.to_numpy()), factors), columns=table.columns)
    groups = families.present(table.columns)
    figure, grid = style.grid(len(groups), 1.8, 1.8, narrow, top=0.4, sharey=True)
    for axes, family in zip(grid.flat, groups, strict=False):
        _panel(axes, family, shares, factors)
        axes.set_xticks(marks, [f"{mark:g}" for mark in marks])
        axes.minorticks_off()
    for axes in grid[-1, :]:
        axes.set_xlabel(f"{what} over the best law's")
    style.label_rows(figure, "share of starts")
    return figure, sentence(groups, shares, what, marks[-1], len(table))


def sentence(groups: list[families.Family], shares: pd.DataFrame, what: str, farthest: float, starts: int) -> str:
    """What the figure shows, in words."""
    ends = {name: (shares[name].iloc[0], shares[name].iloc[-1]) for name in shares}
    words = (
        f"{word} {ends[name][0]:.0%} and {ends[name][1]:.0%}" for family in groups for name, word in family.laws.items()
    )
    return (
        f"Of {starts} starts, the share from which a law has the least {what}, and from which it has at most "
        f"{farthest:g} times the least: {', '.join(words)}."
    )


def _panel(axes: Axes, family: families.Family, shares: pd.DataFrame, factors: np.ndarray) -> None:
    for name in shares:
        if name not in family.laws:
            axes.plot(factors[::COARSE], shares[name].iloc[::COARSE], color=REST, linewidth=0.6, zorder=1)
    # curves that end together are named in the order in which they lie before
    ends = [float(shares[name].iloc[-1] + LABELLED * shares[name].mean()) for name in family.laws]
    places, lines = stacked(ends), lines_of(family)
    for (name, word), place, line in zip(family.laws.items(), places, lines, strict=True):
        colour = style.look(name).colour
        axes.plot(factors, shares[name], color=colour, linestyle=line, zorder=3)
        beside: dict = {"transform": axes.get_yaxis_transform()}
        height = max(LABELLED / 2.0, place)
        axes.plot(SAMPLE, [height] * 2, color=colour, linestyle=line, clip_on=False, **beside)
        style.label_line(axes, SAMPLE[1] + 0.02, height, word, colour, **beside)
    axes.set(xscale="log", xlim=(1.0, factors[-1]), ylim=(0.0, 1.03), title=family.title)
    axes.set_yticks([0.0, 0.5, 1.0], ["0", "50 %", "100 %"])


def stacked(ends: list[float]) -> list[float]:
    """Heights of labels in the order of the ends, from the top down, LABELLED apart and not above the panel."""
    places, above = dict.fromkeys(range(len(ends)), 0.0), 1.0 + LABELLED
    for i in sorted(places, key=lambda i: -ends[i]):
        places[i] = above = min(ends[i], above - LABELLED)
    return [places[i] for i in range(len(ends))]


def lines_of(family: families.Family) -> list:
    """A line for each law: its own, or where one regulator is there several times the next of OTHER_LINES."""
    looks = [style.look(name) for name in family.laws]
    is_told_apart = len({look.colour for look in looks}) == len(looks)
    return [look.line for look in looks] if is_told_apart else list(OTHER_LINES[: len(looks)])
