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

LABEL_GAP = 0.05
"""Least distance of two names beside the plane, as a share of the fastest rate."""

ABBREVIATED = families.word(FEEDBACK), "f-l"
"""The longest name, and what stands for it on the plane."""


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
    """Return what a tick costs, and the time in which 99 % of the uniform starts settle."""
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
    named = [law for law in places if law in PAPERS or coverage(found, law) == len(COVERAGE) - 1]
    figure.legend(loc="outside upper left", ncols=1 if narrow else 3, columnspacing=1.4)
    heights = style.apart([places[law][1] for law in named], LABEL_GAP * fastest)
    for law, height in zip(named, heights, strict=True):
        colour, word = COLOURS[coverage(found, law)], families.word(law).replace(*ABBREVIATED)
        line = {"arrowstyle": "-", "color": colour, "linewidth": 0.5, "shrinkA": 0, "shrinkB": 3}
        at = {"xytext": (1.01 * edge, height), "ha": "left", "va": "center", "color": colour, "fontsize": 8.5}
        axes.annotate(word, places[law], arrowprops=line, annotation_clip=False, **at)
    return figure, sentence(found)


def sentence(found: Measured) -> str:
    """Return the laws that settle everywhere, in words."""
    told = []
    for kind in (2, 1):
        named = ", ".join(
            f"{families.word(law)} ({cost(found, law)}; {found.number('time', law):.2f} s)"
            for law in shown(found)
            if coverage(found, law) == kind
        )
        told.append(f"{COVERAGE[kind].capitalize()}: {named or 'none'}.")
    return f"Cost of a tick against settling time, a mark a law. {' '.join(told)}"
