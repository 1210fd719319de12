"""Cost against performance: operations per control step and the time in which nearly all starts settle, a dot a law."""

import math
from typing import Any, NamedTuple

import numpy as np
from matplotlib.ticker import FixedLocator, NullFormatter, NullLocator

from bench.experiments.tables.run import FREE_BODY, MAIN_ENGINE, Run
from bench.findings.claims import adequacy
from bench.findings.theory import closed_form
from report.figures.cost.cost import LATER, PAPERS_ORDER, count_words, name_counts
from report.figures.kit import families, laws, style
from report.figures.kit.inline import Drawing, responsive_picture
from report.figures.kit.quotes import quote

NEVER_S = 2.5
"""Height at which a law is drawn with which nearly all starts never settle."""
BAND_S, TOP_S = 2.3, 2.7
LOWEST_S = 0.4
TIMES_S = (0.5, 1, 1.5, 2)
OPERATIONS = (40, 60, 100, 200)
LIST_AT = 112
"""Place of the list of fast laws: right of their dots [operations]."""
LIST_HEAD_S, LIST_FOOT_S = 2.1, 1.32
ABOVE_S = 0.13


class LawPoint(NamedTuple):
    """One law in the plane: flops and calls per control step, and the time in which 99 % of the starts settle [s]."""

    law: str
    flops: int
    calls: int
    time_s: float

    @property
    def operations(self) -> int:
        """Return flops and calls, each counted once."""
        return self.flops + self.calls


def facts(run: Run) -> dict[str, Any]:
    """Return the plane, the paper's sentence, and the limit of what counts as fast."""
    points = list_points(run)
    limit = adequacy.SLOW * closed_form.linear_settling(*run.gains())
    return {
        "quote": quote("C17"),
        "laws": len(points),
        "limit": f"{limit:.2f}",
        "slow": f"{adequacy.SLOW:g}",
        "finding": describe_plane(points, limit),
        "picture": draw_plane(points, limit),
    }


def list_points(run: Run) -> list[LawPoint]:
    """Return the laws that have uniform starts and a cost, without those that are wrong on purpose."""
    costs = run.rows("costs", **FREE_BODY, branch="typical")
    points = []
    for law in adequacy.every(run, MAIN_ENGINE):
        if law.name in families.CONTROLS:
            continue
        spent = adequacy.tallied(costs[costs["contender"] == law.name], with_goal=True)
        points.append(LawPoint(law.name, spent.flops, spent.calls, law.pace.value))
    return points


def describe_plane(points: list[LawPoint], limit_s: float) -> str:
    """Say which laws settle nearly all starts in time with fewer operations than the paper's fast law."""
    known = {point.law: point for point in points}
    missing = [law for law in PAPERS_ORDER if law not in known]
    if missing:
        return "Not tested: this run lacks one of Murphy's laws."
    fast = [point for point in points if point.time_s <= limit_s]
    papers_fast = [point for point in fast if point.law in PAPERS_ORDER]
    if not papers_fast:
        return f"None of Murphy's laws settles from 99 % of the starts within {limit_s:.2f} s."
    cheapest = min(papers_fast, key=lambda point: point.operations)
    later = [point for point in fast if point.law not in adequacy.PAPERS]
    better = [point for point in later if point.operations <= cheapest.operations]
    count = {0: "No later law is", 1: "1 later law is"}.get(len(better), f"{len(better)} later laws are")
    takes = "takes" if len(better) < 2 else "take"
    return (
        f"Of Murphy's laws that settle from 99 % of the starts within {limit_s:.2f} s, "
        f"{families.word(cheapest.law)} takes the fewest operations: {name_counts(cheapest.flops, cheapest.calls)}. "
        f"{count} as fast and {takes} no more operations than this law."
    )


@responsive_picture
def draw_plane(points: list[LawPoint], limit_s: float, narrow: bool) -> Drawing:
    """Draw a dot a law: the paper's three and the later ones of the answer by name, all others in grey."""
    figure, axes = style.panels(height=3.6 if narrow else 3.0, narrow=narrow)
    named = (*PAPERS_ORDER, *LATER)
    for point in sorted(points, key=lambda point: point.law in named):
        is_named = point.law in named
        look = style.look(point.law)
        axes.plot(
            point.operations,
            height_of(point),
            marker=look.marker if is_named else "o",
            markersize=7 if is_named else 4.5,
            color=look.colour if is_named else style.MUTED,
            alpha=1.0 if is_named else 0.55,
            linestyle="none",
        )
    axes.axhspan(BAND_S, TOP_S, facecolor=style.GRID, alpha=0.45, zorder=0)
    axes.axhline(limit_s, color=style.MUTED, linewidth=0.9, linestyle=style.DASHED)
    label_laws(axes, [point for point in points if point.law in named], limit_s)
    axes.set(xscale="log", ylim=(LOWEST_S, TOP_S))
    axes.set(xlabel="operations per control step", ylabel="time for 99 % of starts [s]")
    axes.xaxis.set_major_locator(FixedLocator(OPERATIONS))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set_xticklabels([*map(str, OPERATIONS)])
    axes.yaxis.set_major_locator(FixedLocator([*TIMES_S, NEVER_S]))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.set_yticklabels([*map(str, TIMES_S), "never"])
    said = "; ".join(describe_point(point) for point in points)
    return figure, f"Time in which 99 % of the starts settle against operations per control step: {said}."


def describe_point(point: LawPoint) -> str:
    """Write one law of the alternative text."""
    time = "never" if math.isinf(point.time_s) else f"{point.time_s:.2f} s"
    return f"{laws.title(point.law)} {count_words(point.flops, point.calls)}, {time}"


def label_laws(axes: Any, points: list[LawPoint], limit_s: float) -> None:
    """Name the laws: slow ones beside their dots, fast ones, which lie together, in a list with a line to each dot."""
    slow = [point for point in points if point.time_s > limit_s]
    fast = [point for point in points if point.time_s <= limit_s]
    for point in slow:
        colour = style.look(point.law).colour
        name = families.word(point.law)
        if math.isinf(point.time_s):
            style.label_line(axes, 1.06 * point.operations, NEVER_S, name, colour)
        else:  # above the dot, because other slow laws lie to its right
            style.label_line(axes, 0.97 * point.operations, point.time_s + ABOVE_S, name, colour)
    fast.sort(key=lambda point: (-point.time_s, point.operations))
    heights = np.linspace(LIST_HEAD_S, LIST_FOOT_S, len(fast))
    for point, height in zip(fast, heights, strict=True):
        colour = style.look(point.law).colour
        style.label_line(axes, LIST_AT, float(height), families.word(point.law), colour)
        line = [[point.operations, 0.98 * LIST_AT], [point.time_s, float(height)]]
        axes.plot(*line, color=style.MUTED, linewidth=0.6, zorder=1)


def height_of(point: LawPoint) -> float:
    """Return where a law is drawn: at its time, or in the band of those that never settle."""
    return NEVER_S if math.isinf(point.time_s) else point.time_s
