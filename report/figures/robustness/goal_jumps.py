"""Goals that jump while the body moves: how often a law then unwinds, and when it settles, its memory kept or reset."""

import math
from typing import Any, NamedTuple

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from bench.experiments.tables.run import Run
from bench.findings.perturbed import DETOUR, FAR_RAD
from bench.findings.selection.regions import find_default
from bench.findings.selection.reset import KEPT, RESET, SOON_S, describe_resets
from report.figures.kit import families, style
from report.figures.kit.inline import Drawing, responsive_picture
from report.figures.kit.page import in_run
from report.figures.robustness.half_turn_noise import regulator_of
from report.figures.robustness.robustness import along, counted, laws


class Jumps(NamedTuple):
    """What the starts of a law do after a jump of the goal.

    Attributes:
        long_percent: Share of paths over DETOUR times the angle at the jump [%].
        longest_deg: The longest path [deg].
        time_s: The greatest median settling time of a level [s].
    """

    long_percent: float
    longest_deg: float
    time_s: float


class Reset(NamedTuple):
    """A law's jumps with its memory kept, and with it reset."""

    law: str
    kept: Jumps
    reset: Jumps


PANELS = {
    "long_percent": "long paths [%]",
    "longest_deg": "longest path [deg]",
    "delay_ms": "settles later by [ms]",
}
"""Measure -> the label of its axis; the last is the median settling time less that with the memory kept."""


def soon(run: Run, axis: str) -> pd.DataFrame:
    """Return rows of `by_level` of the jumps up to SOON_S, without the negative controls."""
    rows, known = counted(run, axis), laws(along(run, axis), controls=False)
    return rows[(rows["level"] > 0.0) & (rows["level"] <= SOON_S) & rows["contender"].isin(known)]


def measure(rows: pd.DataFrame) -> Jumps:
    """Return the measures of a law over the rows of all levels."""
    return Jumps(
        long_percent=100.0 * rows["long"].sum() / rows["far"].sum(),
        longest_deg=math.degrees(rows["path_rad"].max()),
        time_s=float(rows["median_s"].max()),
    )


def compare_paths(run: Run, kept: pd.DataFrame, reset: pd.DataFrame) -> list[Reset]:
    """Return each law with memory that always settles, with its memory kept and reset; the most long paths first."""
    found = []
    for law in laws(along(run, KEPT), controls=False):
        both = [rows[rows["contender"] == law] for rows in (kept, reset)]
        settles = all((rows["good"] == rows["starts"]).all() for rows in both)
        if regulator_of(law).memory and settles:
            found.append(Reset(law, *map(measure, both)))
    return sorted(found, key=lambda one: -one.kept.long_percent)


@responsive_picture
def draw_resets(resets: list[Reset], narrow: bool) -> Drawing:
    """Draw a row a law and a panel a measure: a full mark with the memory kept, an empty one with it reset."""
    shape = (len(PANELS), 1) if narrow else (1, len(PANELS))
    height = 0.27 * len(resets) + 0.55
    figure, grid = style.panels(*shape, height=0.35 + height * shape[0], narrow=narrow, sharey=True, squeeze=False)
    places = range(len(resets))
    for axes, (field, label) in zip(grid.flat, PANELS.items(), strict=True):
        for place, law in zip(places, resets, strict=True):
            draw_pair(axes, place, law, field)
        axes.set(ylim=(len(resets) - 0.4, -0.6), xlabel=label)
        axes.set_yticks(places, [families.word(law.law) for law in resets], fontsize=10)
        axes.margins(x=0.12)
        style.listed(axes)
    draw_key(figure)
    return figure, f"After a jump of the goal, memory kept and reset: {'; '.join(map(describe_law, resets))}."


def draw_pair(axes: Axes, place: int, law: Reset, field: str) -> None:
    """Draw a measure of a law with the memory kept and reset, and the line between them."""
    colour = style.look(law.law).colour
    kept, reset = pair_of(law, field)
    axes.plot([kept, reset], [place, place], color=colour, linewidth=1.6)
    axes.plot(kept, place, "o", markersize=6, color=colour)
    axes.plot(reset, place, "o", markersize=6, color=colour, markerfacecolor=style.PAPER, markeredgewidth=1.4)


def pair_of(law: Reset, field: str) -> tuple[float, float]:
    """Return a measure of PANELS with the memory kept, and with it reset."""
    if field == "delay_ms":
        return 0.0, 1000.0 * (law.reset.time_s - law.kept.time_s)
    return getattr(law.kept, field), getattr(law.reset, field)


def draw_key(figure: Figure) -> None:
    """Say above the picture what the marks mean."""
    dot: dict[str, Any] = {"marker": "o", "markersize": 6, "linestyle": "", "color": style.INK}
    handles = [Line2D([], [], **dot), Line2D([], [], **dot, markerfacecolor=style.PAPER)]
    figure.legend(handles, ["memory kept", "memory reset"], loc="outside upper left", ncols=2, fontsize=10)


def describe_law(law: Reset) -> str:
    """Return the measures of a law in words."""
    kept, reset = law.kept, law.reset
    return (
        f"{families.word(law.law)} long paths {kept.long_percent:.1f} % and {reset.long_percent:.1f} %, longest path "
        f"{kept.longest_deg:.0f} and {reset.longest_deg:.0f} degrees, median settling time {kept.time_s:.3f} s and "
        f"{reset.time_s:.3f} s"
    )


def describe_measures(resets: list[Reset]) -> str:
    """Say for how many laws a reset shortens the path, and for how many it saves time."""
    shorter = sum(law.reset.long_percent < law.kept.long_percent for law in resets)
    sooner = sum(law.reset.time_s < law.kept.time_s for law in resets)
    most = max(resets, key=lambda law: law.kept.long_percent)
    before, after = (f"{side.long_percent:.1f} %" for side in (most.kept, most.reset))
    return (
        f"A reset of the memory makes long paths rarer with {shorter or 'none'} of these {len(resets)} laws. With "
        f"{families.word(most.law)}, the share of long paths drops from {before} to {after}. A reset saves time with "
        f"{sooner or 'none'} of these laws"
    )


def list_times(rows: pd.DataFrame) -> str:
    """Return the times of the jumps [ms] as alternatives."""
    *most, last = (f"{1000.0 * level:g}" for level in sorted(rows["level"].unique()))
    return f"{', '.join(most)} or {last}" if most else last


def facts(run: Run) -> dict:
    """Return how many starts jump, when, which ratio counts, and what a reset changes for each law."""
    kept, reset = soon(run, KEPT), soon(run, RESET)
    resets = compare_paths(run, kept, reset)
    return {
        "n": int(kept["starts"].max()),
        "times": f"{list_times(kept)} ms",
        "detour": f"{DETOUR:g}",
        "near": f"{FAR_RAD:g}",
        "paths": in_run(draw_resets, resets),
        "finding": describe_measures(resets),
        "resets": describe_resets(find_default()),
    }
