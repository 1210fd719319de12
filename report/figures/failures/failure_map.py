"""What the page on failures shows: which starts each of the paper's laws loses, in numbers and against the angle."""

import math
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.ticker import FixedLocator, NullLocator

from bench.experiments.tables import read
from bench.experiments.tables.schema import RESULTS
from bench.findings.claims.tables import settled
from bench.findings.maps import at_gains, counted, lost_share, read_maps
from bench.law.inputs import PAPERS_GAINS
from report.figures.kit import html, laws, style
from report.figures.kit.inline import Drawing, responsive_picture
from report.figures.kit.laws import FEEDBACK, LINEARIZED, MATRIX
from report.figures.kit.page import Run, in_run

SETS = ("uniform", "half-turn", "poles", "wraps", "box")
"""Start sets at rest whose goal is zero."""

DRAWN = 1000
"""Uniform dots a panel: the first of a low-discrepancy sequence, which cover SO(3) evenly at any number."""

TIMES = (0.5, 1, 2, 5)
LOWEST, RAIL, NEVER = 0.45, 11.0, 17.0  # [s] of the log scale: its foot, and where the rail above it begins and lies
CEILING = NEVER**2 / RAIL
ASIDE = 0.16  # decades: dots of the rail are spread over its height, or hundreds would lie on one line


def facts(run: Run) -> dict:
    """Return how much each law loses, the paper's three laws from every angle, and where the failures begin."""
    maps = read_maps(RESULTS / "maps")  # those that came with the benchmark
    mapped = counted(at_gains(maps, PAPERS_GAINS))
    own = mapped[(mapped["contender"] == LINEARIZED) & (mapped["most_speed"] == 0.0)]  # at rest
    value, low, high = (100.0 * one for one in lost_share(int(own["lost"].sum()), int(own["starts"].sum())))
    return {
        "mapped": html.number(int(mapped["starts"].min())),
        "mapped_l": f"{value:.2f} % ({low:.2f} to {high:.2f})",
        # |Edot| over |omega| half a degree off a pole
        "gain": f"{1.0 / math.sqrt(1.0 - math.cos(math.radians(0.5))):.0f}",
        "hero": in_run(lambda: hero(run.rows("episodes", engine="ideal-rk4"))),
        **(in_run(lambda: on_the_map(run)) or {}),
    }


def on_the_map(run: Run) -> dict:
    """Return what the uniform starts of the run say, on the continuous plant, whose end no shorter step moves."""
    rows = read.converged(run.rows("episodes", task="free-body", engine="ideal-rk4", start_set="uniform"))
    linearized, *others = (rows[rows["contender"] == name] for name in (LINEARIZED, MATRIX, FEEDBACK))
    failed, *lost = (own[~settled(own)] for own in (linearized, *others))
    return {
        "n": len(linearized),
        "failed_l": len(failed),
        "failed_others": " and ".join(str(len(own)) for own in lost) if any(map(len, lost)) else "none",
        "least": f"{np.floor(np.degrees(failed['alpha0'].abs().min())):.0f}",
        "least_gamma": f"{np.degrees(failed['gamma0'].abs().min()):.0f}",
    }


@responsive_picture
def hero(episodes: pd.DataFrame, narrow: bool) -> Drawing:
    """Draw one engine's settling time by initial angle, from rest with goal zero; what fails is in the rail above."""
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
    style.dots(axes, np.degrees(drawn["angle0_rad"]), drawn["settling_time_s"], colour, 3.0, alpha=0.45, zorder=3)
    failed = rows[~is_settled]
    aside = np.random.default_rng(0).permutation(np.linspace(-ASIDE, ASIDE, max(2, len(failed)))[: len(failed)])
    style.dots(axes, np.degrees(failed["angle0_rad"]), NEVER * 10.0**aside, colour, 2.6)
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
