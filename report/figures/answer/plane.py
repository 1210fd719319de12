"""All laws on one plane of cost and speed, marked by what settles everywhere and what no noise holds."""

from __future__ import annotations

import math

from bench.findings.claims.adequacy import PAPERS
from bench.findings.selection.measured import Measured
from bench.findings.selection.needs import EVERYWHERE, UNHELD
from bench.findings.selection.words import cost
from report.figures.kit import families, style
from report.figures.kit.inline import responsive_picture
from report.figures.kit.rows import FEEDBACK

COVERAGE = ("loses starts", "settles everywhere, held by noise", "settles everywhere, not held")
MARKERS = ("X", "o", "*")
SIZES = (5.5, 6.0, 11.0)
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
"""Offsets of a name from its mark [pt], the best first."""


def coverage(found: Measured, law: str) -> int:
    """Index into COVERAGE."""
    if not EVERYWHERE.has(found, law):
        return 0
    return 2 if UNHELD.has(found, law) else 1


def shown(found: Measured) -> list[str]:
    """All laws but the negative controls."""
    return [law for law in found.laws if law not in families.CONTROLS]


def across(found: Measured) -> tuple[dict[str, float], str]:
    """Return what each law costs: its share of a whole controller's tick [%].

    MuJoCo's actuator, which is not timed apart from its step, is left out. Where others were not timed: operations,
    each counted once.
    """
    laws = [law for law in shown(found) if not found.tables.contenders[law].regulator.in_engine]
    shares = {law: found.number("tick", law) for law in laws}
    if all(map(math.isfinite, shares.values())):
        return shares, "time of the law, % of a whole controller's tick"
    return {law: float(sum(found.tables.spent(law))) for law in laws}, "operations a tick, each counted once"


@responsive_picture
def plane(found: Measured, *, narrow: bool = False):
    """What a tick costs, and the time in which 99 % of the uniform starts settle."""
    figure, axes = style.panels(height=6.2 if narrow else 5.6, narrow=narrow)
    costs, label = across(found)
    places = {law: (cost, 1.0 / found.number("time", law)) for law, cost in costs.items()}
    edge = 1.06 * max(costs.values())
    fastest = max(rate for _, rate in places.values())
    for law, place in places.items():
        kind = coverage(found, law)
        marks = {"linestyle": "none", "marker": MARKERS[kind], "markersize": SIZES[kind], "color": COLOURS[kind]}
        axes.plot(*place, zorder=3 + kind, clip_on=False, **marks)
    for kind, word in enumerate(COVERAGE):
        axes.plot(
            [], [], linestyle="none", color=COLOURS[kind], label=word, marker=MARKERS[kind], markersize=SIZES[kind]
        )
    axes.set(xlim=(0.0, edge), ylim=(1.12 * fastest, -0.06 * fastest), xlabel=label)
    ticks = [tick for tick in SECONDS if 1.0 / tick < 1.12 * fastest]
    axes.set_yticks([*(1.0 / tick for tick in ticks), 0.0], [*(f"{tick:g}" for tick in ticks), "never"])
    axes.set(ylabel="99 % of all starts settled in [s]")
    named = list(places)
    if narrow:
        named = [law for law in named if law in PAPERS or coverage(found, law) == len(COVERAGE) - 1]
    figure.legend(loc="outside upper left", ncols=1 if narrow else 3, columnspacing=1.4)
    _label(axes, places, {law: COLOURS[coverage(found, law)] for law in reversed(named)})
    return figure, sentence(found)


def _label(axes, places: dict[str, tuple[float, float]], colours: dict[str, str]) -> None:
    """Name marks where a name meets no other name and no mark: at the first such place of AROUND, or not at all.

    Args:
        places: of all marks. colours: of the names, the first to be placed first.
    """
    figure = axes.figure
    figure.draw_without_rendering()
    taken = [_box(axes, [place], 4.0) for place in places.values()]
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
    """The laws that settle everywhere, in words."""
    told = []
    for kind in (2, 1):
        named = ", ".join(
            f"{families.word(law)} ({cost(found, law)}; {found.number('time', law):.2f} s)"
            for law in shown(found)
            if coverage(found, law) == kind
        )
        told.append(f"{COVERAGE[kind].capitalize()}: {named or 'none'}.")
    return f"Cost of a tick against settling time, a mark a law. {' '.join(told)}"
