"""A number of every law over the levels of one perturbation: a panel a family, every other law in it in grey."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

import tasks
from bench.tables.statistics import quantile_estimate
from report.figures.comparison.profiles import REST, lines_of
from report.figures.kit import families, style
from report.figures.kit.inline import Picture, responsive_picture
from report.figures.robustness.rows import levels, plain, with_unit

LABELLED = 0.115
"""Least distance of two labels beside curves, as a share of the panel's height."""

SAMPLE = (1.03, 1.13)
"""Where a label's piece of line lies, in widths of the panel."""

ROOM = 0.08
"""Above the highest mark and below the lowest, as a share of what lies between."""


class Measure(NamedTuple):
    """What is drawn: the median of a column over starts, times a factor.

    title: with its unit. is_log: of its axis.
    """

    column: str
    title: str
    factor: float = 1.0
    is_log: bool = False


TIME = Measure("time_s", "median settling time [s]")
OVER_LEAST = Measure("over_least", "settling time over the least", is_log=True)
TURNED = Measure("turned_deg", "median of all that the body turned [deg]")


def estimates(rows: pd.DataFrame, measure: Measure) -> pd.DataFrame:
    """law, level, value, low, high: medians with their bootstrap intervals.

    Args:
        rows: of `rows.along`.
    """
    found = [
        (law, level, *(measure.factor * part for part in quantile_estimate(own[measure.column].to_numpy(), 0.5)))
        for (law, level), own in rows.groupby(["contender", "level"], observed=True)
    ]
    return pd.DataFrame(found, columns=["law", "level", "value", "low", "high"])


def panels(rows: pd.DataFrame, name: str, measure: Measure, theory: Callable[[float], float] | None = None) -> Picture:
    """A panel a family: the measure over the levels.

    Args:
        rows: of `rows.along`. name: of the perturbation.
        theory: level -> what a closed form says, in the column's unit.
    """
    there = levels(rows)
    curve = [measure.factor * theory(level) for level in there] if theory else None
    return _panels(estimates(rows, measure), name, measure, there, curve)


@responsive_picture
def _panels(found: pd.DataFrame, name: str, measure: Measure, there: list[float], curve, *, narrow=False):
    groups = families.present(found["law"])
    figure, grid = style.grid(len(groups), 1.75, 1.75, narrow, top=0.5, sharey=True)
    wide = found.pivot(index="level", columns="law", values="value").reindex(there)
    limits = _limits(wide, curve, measure.is_log)
    for axes, family in zip(grid.flat, groups, strict=False):
        axes.set(ylim=limits, yscale="log" if measure.is_log else "linear", title=family.title)
        _panel(axes, family, found, wide, limits)
        if curve is not None:
            axes.plot(range(len(there)), curve, color=style.INK, linewidth=0.8, linestyle=style.DOTTED, zorder=4)
        axes.set_xticks(range(len(there)), [plain(level) for level in there], fontsize=9)
        axes.minorticks_off()
    unit = tasks.axis(name).unit
    title = tasks.axis(name).title + ("" if unit == "1" else f" [{unit.replace('^2', '²')}]")
    figure.supxlabel(title, fontsize=10.5)
    figure.supylabel(measure.title, fontsize=10.5)
    return figure, sentence(groups, wide, name, measure)


def _limits(wide: pd.DataFrame, curve, is_log: bool) -> tuple[float, float]:
    """Of the vertical axis, by the laws that are no negative controls."""
    shown = wide[[law for law in wide if law not in families.CONTROLS]].to_numpy()
    values = np.concatenate([shown[np.isfinite(shown)], [one for one in curve or [] if np.isfinite(one) and one > 0]])
    low, high = float(values.min()), float(values.max())
    if is_log:
        return low / 1.5, high * 1.5
    room = max(ROOM * (high - low), 0.02 * high)
    return low - room, high + room


def _panel(axes: Axes, family: families.Family, found: pd.DataFrame, wide: pd.DataFrame, limits) -> None:
    places = np.arange(len(wide))
    for law in wide:
        if law not in family.laws:
            axes.plot(places, wide[law].where(np.isfinite(wide[law])), color=REST, linewidth=0.6, zorder=1)
    heights = stacked([_height(axes, wide[law], limits) for law in family.laws])
    for (law, word), height, line in zip(family.laws.items(), heights, lines_of(family), strict=True):
        look = style.look(law)
        own = found[found["law"] == law].set_index("level").reindex(wide.index)
        whole = own.where(np.isfinite(own[["value", "low", "high"]]).all(axis=1), other=np.nan)
        axes.vlines(places, whole["low"], whole["high"], color=look.colour, linewidth=3.0, alpha=0.25, zorder=2)
        value = own["value"].where(np.isfinite(own["value"]))
        axes.plot(places, value, color=look.colour, linestyle=line, marker=look.marker, markersize=3.6, zorder=3)
        at = axes.transAxes
        axes.plot(SAMPLE, [height] * 2, color=look.colour, linestyle=line, clip_on=False, transform=at)
        style.label_line(axes, SAMPLE[1] + 0.02, height, word, look.colour, transform=at, fontsize=9)


def _height(axes: Axes, values: pd.Series, limits) -> float:
    """Where a curve ends, as a share of the panel's height; at the top if it is nowhere finite."""
    finite = values[np.isfinite(values)]
    if finite.empty:
        return 1.0
    scale = axes.yaxis.get_transform().transform
    low, high, last = scale(np.array([*limits, np.clip(finite.iloc[-1], *limits)]))
    return float((last - low) / (high - low))


def stacked(ends: list[float]) -> list[float]:
    """Heights of labels, LABELLED apart and within the panel, in the order of the curves' ends."""
    moved = style.apart([end + 1e-6 * i for i, end in enumerate(ends)], LABELLED)
    over, under = max(0.0, max(moved) - 0.97), max(0.0, 0.03 - min(moved))
    return [place - over + under for place in moved]


def sentence(groups: list[families.Family], wide: pd.DataFrame, name: str, measure: Measure) -> str:
    """What the figure shows, in words: every law at the first level and the last."""
    first, last = (with_unit(level, name) for level in (wide.index[0], wide.index[-1]))
    words = (
        f"{families.word(law)} {_number(wide[law].iloc[0])} and {_number(wide[law].iloc[-1])}"
        for family in groups
        for law in family.laws
    )
    return f"{tasks.axis(name).title}, {measure.title}, at {first} and at {last}: {', '.join(words)}."


def _number(value: float) -> str:
    return f"{value:.3g}" if np.isfinite(value) else "never"
