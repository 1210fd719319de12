"""All laws on one plane of cost and speed, with three fronts: all, what settles everywhere, what no noise holds."""

from __future__ import annotations

import itertools
import math

import numpy as np

from bench.findings.claims.adequacy import CALL_PRICE, DEAR, PAPERS, SLOW
from bench.findings.selection.front import front
from bench.findings.selection.measured import Measured
from bench.findings.selection.needs import EVERYWHERE, UNHELD
from report.figures.kit import families, style
from report.figures.kit.inline import responsive_picture
from report.figures.kit.rows import FEEDBACK

COVERAGE = ("loses starts", "settles everywhere, held by noise", "settles everywhere, not held")
MARKERS = ("X", "o", "*")
SIZES = (5.5, 6.0, 11.0)
LINES = ((0, (1.5, 1.5)), (0, (5, 2)), "-")
COLOURS = (style.MUTED, "#0072b2", "#d55e00")

SECONDS = (0.5, 0.6, 0.7, 0.8, 1.0, 1.5, 2.0, 3.0)
"""Ticks of the upright axis, which is even in 1/time: fast laws get room, and "never" has a place."""

ABBREVIATED = families.word(FEEDBACK), "f-l"
"""The longest name, and what stands for it on the plane."""

CLOSE_PT = 12.0
"""A name farther from its mark than this [pt] is joined to it by a line."""

AROUND = sorted(
    ((side * reach, lift) for reach in (7, 14, 24, 36, 50) for lift in range(-48, 49, 6) for side in (1, -1)),
    key=lambda shift: math.hypot(shift[0], 1.5 * shift[1]),
)
"""Where a name may stand beside its mark [pt], the best place first."""


def coverage(found: Measured, law: str) -> int:
    """Index into COVERAGE."""
    if not EVERYWHERE.has(found, law):
        return 0
    return 2 if UNHELD.has(found, law) else 1


def shown(found: Measured) -> list[str]:
    """All laws but the negative controls."""
    return [law for law in found.laws if law not in families.CONTROLS]


def fronts(found: Measured) -> list[list[str]]:
    """Of each coverage and what is better covered, the laws that none beats in cost and time; the cheapest first."""
    parts = []
    for least in range(len(COVERAGE)):
        laws = [law for law in shown(found) if coverage(found, law) >= least]
        points = np.array([[found.number("cost", law), found.number("time", law)] for law in laws]).reshape(-1, 2)
        is_there = front(points) & np.all(np.isfinite(points), axis=1)
        parts.append([law for law, ahead in zip(laws, is_there, strict=True) if ahead])
    return parts


@responsive_picture
def plane(found: Measured, small_s: float, *, narrow: bool = False):
    """Cost a tick and the time in which 99 % of the uniform starts settle; steps join each front.

    Args:
        small_s: settling time of a small error.
    """
    figure, axes = style.panels(height=6.2 if narrow else 5.6, narrow=narrow)
    laws, ahead = shown(found), fronts(found)
    places = {law: (found.number("cost", law), 1.0 / found.number("time", law)) for law in laws}
    edge = 1.06 * max(cost for cost, _ in places.values())
    lines = [_steps([places[law] for law in members], edge) for members in ahead]
    for kind, points in enumerate(lines):
        drawn = {"color": COLOURS[kind], "linestyle": LINES[kind], "linewidth": 1.1, "zorder": 1}
        axes.plot([x for x, _ in points], [y for _, y in points], **drawn)
    for law, place in places.items():
        kind = coverage(found, law)
        marks = {"linestyle": "none", "marker": MARKERS[kind], "markersize": SIZES[kind], "color": COLOURS[kind]}
        axes.plot(*place, zorder=3 + kind, clip_on=False, **marks)
    for kind, word in enumerate(COVERAGE):
        marks = {"linestyle": LINES[kind], "marker": MARKERS[kind], "markersize": SIZES[kind], "linewidth": 1.1}
        axes.plot([], [], color=COLOURS[kind], label=word, **marks)
    dearest = DEAR * min(places[law][0] for law in laws if law in PAPERS)
    bounds = [[(dearest, 0.0), (dearest, 3.0)], [(0.0, 1.0 / (SLOW * small_s)), (edge, 1.0 / (SLOW * small_s))]]
    for (x0, y0), (x1, y1) in bounds:
        axes.plot([x0, x1], [y0, y1], color=style.MUTED, linewidth=0.8, linestyle=(0, (8, 3)), zorder=0)
    fastest = max(rate for _, rate in places.values())
    axes.set(xlim=(0.85 * min(cost for cost, _ in places.values()), edge), ylim=(1.12 * fastest, -0.06 * fastest))
    ticks = [tick for tick in SECONDS if 1.0 / tick < 1.12 * fastest]
    axes.set_yticks([*(1.0 / tick for tick in ticks), 0.0], [*(f"{tick:g}" for tick in ticks), "never"])
    axes.set(xlabel=f"flops a tick, a call counted as {CALL_PRICE:g}", ylabel="99 % of all starts settled in [s]")
    named = laws
    if narrow:
        first = {law for members in ahead for law in members}
        named = [law for law in laws if law in first or law in PAPERS or coverage(found, law) == len(COVERAGE) - 1]
    figure.legend(loc="outside upper left", ncols=1 if narrow else 3, columnspacing=1.4)
    _label(axes, places, {law: COLOURS[coverage(found, law)] for law in reversed(named)}, [*lines, *bounds])
    return figure, sentence(found)


def _steps(points: list[tuple[float, float]], edge: float) -> list[tuple[float, float]]:
    """Corners of a front's steps: at more cost the time of the last point, up to the edge."""
    corners: list[tuple[float, float]] = []
    for x, y in points:
        corners += [(x, corners[-1][1])] if corners else []
        corners.append((x, y))
    return [*corners, (edge, corners[-1][1])] if corners else []


def _label(axes, places: dict[str, tuple[float, float]], colours: dict[str, str], lines: list) -> None:
    """Name marks where a name meets no other, no mark and no line: at the first such place of AROUND, or not at all.

    Args:
        places: of all marks. colours: of the names, the first to be placed first. lines: lists of corners.
    """
    figure = axes.figure
    figure.draw_without_rendering()
    taken = [_box(axes, [place], 4.0) for place in places.values()]
    taken += [_box(axes, list(pair), 1.5) for line in lines for pair in itertools.pairwise(line)]
    whole = axes.get_window_extent()
    for law, colour in colours.items():
        for shift in AROUND:
            side = {"ha": "left" if shift[0] > 0 else "right", "va": "center", "color": colour, "fontsize": 8.5}
            word = families.word(law).replace(*ABBREVIATED)
            text = axes.annotate(word, places[law], shift, textcoords="offset points", **side)
            spot = text.get_window_extent()
            edges = (spot.x0, spot.y0, spot.x1, spot.y1)
            is_inside = whole.x0 <= spot.x0 and spot.x1 <= whole.x1 and whole.y0 <= spot.y0 and spot.y1 <= whole.y1
            if is_inside and not any(_meet(edges, other) for other in taken):
                taken.append(edges)
                if math.hypot(*shift) > CLOSE_PT:
                    line = {"arrowstyle": "-", "color": colour, "linewidth": 0.5, "shrinkA": 0, "shrinkB": 3}
                    axes.annotate("", places[law], shift, textcoords="offset points", arrowprops=line)
                break
            text.remove()


def _box(axes, points: list[tuple[float, float]], margin: float) -> tuple[float, float, float, float]:
    """The box around some points, in pixels."""
    at = axes.transData.transform(points)
    return (*(at.min(axis=0) - margin), *(at.max(axis=0) + margin))


def _meet(one: tuple, other: tuple) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


def sentence(found: Measured) -> str:
    """The fronts in words."""
    said = []
    for kind, members in enumerate(fronts(found)):
        named = ", ".join(
            f"{families.word(law)} ({found.number('cost', law):.0f} flops, {found.number('time', law):.2f} s)"
            for law in members
        )
        whom = ("all laws", "laws that settle everywhere", "those of them that no noise holds")[kind]
        said.append(f"Front of {whom}: {named or 'none'}.")
    return f"Cost against settling time, a mark a law. {' '.join(said)}"
