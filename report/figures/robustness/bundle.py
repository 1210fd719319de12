"""Where all laws are one near the goal: the error left over the levels, laws as a bundle, theory as a line."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd

import tasks
from report.figures.kit import families, style
from report.figures.kit.dots import dots
from report.figures.kit.inline import responsive_picture
from report.figures.robustness.rows import DEG, medians, plain, with_unit

APART = 1.1
"""Factor from the bundle from which a law is drawn in its own colour and named."""

NAMED = 3
"""Laws named in one panel."""


class Strand(NamedTuple):
    """One panel: a perturbation, its rows, and level -> what the linear theory leaves [rad]."""

    name: str
    rows: pd.DataFrame
    theory: Callable[[float], float]


def apart(found: pd.DataFrame) -> list[str]:
    """The laws that at some level are more than a factor of APART from the laws' median, farthest first."""
    ratio = found.div(found.median(axis=1), axis=0)
    spread = np.maximum(ratio, 1.0 / ratio).loc[found.index > 0].max().sort_values(ascending=False)
    return list(spread.index[spread > APART])


@responsive_picture
def bundle(strands: Sequence[Strand], *, narrow=False):
    """A panel a perturbation: every law's error over the levels, and what the linear loop leaves by theory."""
    cols = 1 if narrow else len(strands)
    figure, grid = style.panels(
        len(strands) // cols, cols, height=3.1 * (len(strands) // cols), narrow=narrow, squeeze=False, sharey=True
    )
    words, corners = [], []
    for axes, strand in zip(grid.flat, strands, strict=True):
        found = medians(strand.rows, "tail_rms_rad")
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
        axes.set_xticks(list(found.index), [plain(level) for level in found.index])
        axes.minorticks_off()
        middle = DEG * found.median(axis=1)
        corners.append((axes, float(middle.iloc[0])))
        words.append(
            f"{axis.title}: from {middle.iloc[0]:.2g} at {with_unit(found.index[0], strand.name)} to "
            f"{middle.iloc[-1]:.2g} at {with_unit(found.index[-1], strand.name)}, by theory "
            f"{expected[0]:.2g} to {expected[-1]:.2g}; apart: {', '.join(map(families.word, apart(found))) or 'no law'}"
        )
    for axes, first in corners:  # curves rise: what begins high leaves the lower right corner free
        low, high = axes.get_ylim()
        axes.legend(loc="lower right" if first * first > low * high else "upper left", fontsize=8.5)
    for axes in grid[:, 0]:
        axes.set_ylabel("error that is left [deg]")
    return figure, f"Error that is left in degrees, median over laws. {'. '.join(words)}."


def _short(title: str) -> str:
    return title.replace("Goal that moves", "goal moves").replace("its rate and acceleration told", "all told")
