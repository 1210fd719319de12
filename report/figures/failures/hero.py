"""The front page's figure: settling time against initial angle, one panel a law, and above it what never settles."""

from typing import Any

import numpy as np
import pandas as pd
from matplotlib.ticker import FixedLocator, NullLocator

from report.figures.kit import html, laws, style
from report.figures.kit.dots import dots
from report.figures.kit.inline import Drawing, responsive_picture

SETS = ("uniform", "half-turn", "poles", "wraps", "box")
"""Start sets at rest whose goal is zero."""

DRAWN = 1000
"""Uniform dots a panel: the first of a low-discrepancy sequence, which cover SO(3) evenly at any number."""

TIMES = (0.5, 1, 2, 5)
LOWEST, RAIL, NEVER = 0.45, 11.0, 17.0  # [s] of the log scale: its foot, and where the rail above it begins and lies
CEILING = NEVER**2 / RAIL
ASIDE = 0.16  # decades: dots of the rail are spread over its height, or hundreds would lie on one line


@responsive_picture
def hero(episodes: pd.DataFrame, narrow: bool) -> Drawing:
    """Settling time against initial angle.

    Args:
        episodes: rows of one engine; sets at rest with goal zero are drawn, what fails in the rail above.
    """
    rows = episodes[episodes["start_set"].isin(SETS)]
    parts = [(name, own) for name in laws.TITLES if len(own := rows[rows["contender"] == name])]
    shape, height = ((len(parts), 1), 2.3 * len(parts)) if narrow else ((1, len(parts)), 3.5)
    figure, grid = style.panels(*shape, height=height, narrow=narrow, sharex=True, sharey=True, squeeze=False)
    said = [_panel(axes, *part) for axes, part in zip(grid.flat, parts, strict=True)]
    for axes in grid[-1, :]:
        axes.set_xlabel("initial angle to the goal [deg]")
    for axes in grid[:, 0]:
        axes.set_ylabel("settling time [s]")
    return figure, "Settling time against initial angle, a panel for each law. " + " ".join(said)


def _panel(axes: Any, name: str, rows: pd.DataFrame) -> str:
    title, colour = laws.TITLES[name], style.look(name).colour
    is_uniform, is_settled = rows["start_set"] == "uniform", rows["outcome"] == "settled"
    drawn = pd.concat(
        (rows[is_uniform & is_settled].head(DRAWN), rows[(rows["start_set"] == "half-turn") & is_settled])
    )
    dots(axes, np.degrees(drawn["angle0_rad"]), drawn["settling_time_s"], colour, 3.0, alpha=0.45, zorder=3)
    failed = rows[~is_settled]
    aside = np.random.default_rng(0).permutation(np.linspace(-ASIDE, ASIDE, max(2, len(failed)))[: len(failed)])
    dots(axes, np.degrees(failed["angle0_rad"]), NEVER * 10.0**aside, colour, 2.6)
    axes.axhspan(RAIL, CEILING, facecolor=style.GRID, alpha=0.45, zorder=0)
    axes.set(yscale="log", xlim=(0, 184), ylim=(LOWEST, CEILING), xticks=[0, 60, 120, 180])
    axes.set_title(title, color=colour)
    axes.yaxis.set_major_locator(FixedLocator([*TIMES, NEVER]))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.set_yticklabels([*map(str, TIMES), "never"])
    words = [
        f"{word} {html.number((chosen & ~is_settled).sum())} of {html.number(chosen.sum())}"
        for word, chosen in (("uniform", is_uniform), ("directed", ~is_uniform))
    ]
    axes.text(4, NEVER, "\n".join(words), va="center", fontsize=8, color=style.INK, linespacing=1.3)
    times = rows.loc[is_uniform & is_settled, "settling_time_s"]
    taken = f"; those that do take {times.median():.2f} s (median) to {times.max():.2f} s" if len(times) else ""
    return f"{title}, never settled: {', '.join(words)} starts{taken}."
