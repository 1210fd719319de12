"""Where all laws are one near the goal: the error that is left over the levels, laws as a bundle, theory as a line."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd

import tasks
from bench.tables.statistics import quantile
from report.figures.kit import families, style
from report.figures.kit.dots import dots
from report.figures.kit.inline import responsive_picture
from report.figures.robustness import robustness_rows

APART = 1.1
"""Factor from the bundle from which a law is drawn in its own colour and named."""

DEG = 180.0 / np.pi
NAMED = 3
"""Laws named in one panel."""


class Strand(NamedTuple):
    """One panel: an axis, its rows, and level -> what the linear theory leaves [rad]."""

    name: str
    rows: pd.DataFrame
    theory: Callable[[float], float]


def left(rows: pd.DataFrame) -> pd.DataFrame:
    """Median error over the last second [rad] of the starts that ended well: a row a level, a column a law.

    A law that loses half of its starts has none; negative controls are left out.

    Args:
        rows: of `robustness_rows.along`.
    """
    kept = {}
    for law in robustness_rows.laws(rows):
        if law not in families.CONTROLS:
            own = robustness_rows.of(rows, law)
            kept[law] = own.groupby("level")["tail_rms_rad"].apply(lambda part: float(quantile(part.to_numpy(), 0.5)))
    return pd.DataFrame(kept)


def apart(found: pd.DataFrame) -> list[str]:
    """The laws that at some level of trouble are more than a factor of APART from the laws' median, farthest first."""
    ratio = found.div(found.median(axis=1), axis=0)
    spread = np.maximum(ratio, 1.0 / ratio).loc[found.index > 0].max().sort_values(ascending=False)
    return list(spread.index[spread > APART])


@responsive_picture
def bundle(strands: Sequence[Strand], *, narrow=False):
    """A panel an axis: every law's error over the levels, and what the linear loop leaves by theory."""
    cols = 1 if narrow else len(strands)
    figure, grid = style.panels(
        len(strands) // cols, cols, height=3.1 * (len(strands) // cols), narrow=narrow, squeeze=False, sharey=True
    )
    said, corners = [], []
    for axes, strand in zip(grid.flat, strands, strict=True):
        found = left(strand.rows)
        found = found[found.index > 0]
        expected = [DEG * strand.theory(level) for level in found.index]
        axes.plot([], [], "o", color=style.MUTED, markersize=3.5, label=f"{len(found.columns)} laws")
        for law in found:
            dots(axes, found.index, DEG * found[law], style.MUTED, 4.0, zorder=2)
        for law in apart(found)[:NAMED]:
            look = style.look(law)
            axes.plot(
                found.index, DEG * found[law], color=look.colour, marker=look.marker, label=families.word(law), zorder=3
            )
        axes.plot(found.index, expected, color=style.INK, linestyle=style.DOTTED, label="linear theory", zorder=4)
        axis = tasks.axis(strand.name)
        axes.set(xscale="log", yscale="log", xlabel=f"{_short(axis.title)} [{axis.unit}]")
        axes.set_xticks(list(found.index), [robustness_rows.plain(level) for level in found.index])
        axes.minorticks_off()
        middle = DEG * found.median(axis=1)
        corners.append((axes, float(middle.iloc[0])))
        said.append(
            f"{axis.title}: from {middle.iloc[0]:.2g} at {robustness_rows.said(found.index[0], strand.name)} to "
            f"{middle.iloc[-1]:.2g} at {robustness_rows.said(found.index[-1], strand.name)}, by theory "
            f"{expected[0]:.2g} to {expected[-1]:.2g}; apart: {', '.join(map(families.word, apart(found))) or 'no law'}"
        )
    for axes, first in corners:  # curves rise: what begins high leaves the lower right corner free
        low, high = axes.get_ylim()
        axes.legend(loc="lower right" if first * first > low * high else "upper left", fontsize=8.5)
    for axes in grid[:, 0]:
        axes.set_ylabel("error that is left [deg]")
    return figure, f"Error that is left in degrees, median over laws. {'. '.join(said)}."


def _short(title: str) -> str:
    return title.replace("Goal that moves", "goal moves").replace("its rate and acceleration told", "all told")
