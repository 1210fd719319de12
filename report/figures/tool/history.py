"""The history of builds, drawn as small multiples: a row a benchmark, a column a measure, steps marked."""

from __future__ import annotations

import functools
import itertools
from typing import NamedTuple

import numpy as np

from bench.regression.history import log
from bench.regression.history.series import FLOPS, INSTRUCTIONS, MEASURES, TIME, Point, Series, series
from bench.regression.history.steps import Step, steps
from bench.regression.revisions.measurement import LAW
from report.figures.kit import families, style
from report.figures.kit.html import number
from report.figures.kit.inline import responsive_picture

SHORT = 10
"""Digits of a commit that tell it from every other."""
TITLES = {FLOPS: "flops", INSTRUCTIONS: "instructions", TIME: "time [kernel steps]"}
NARROW_TITLES = {FLOPS: "flops", INSTRUCTIONS: "instr.", TIME: "time"}
BAND = 0.25
"""Relative change that takes a line from the middle of its row to the edge; what goes farther stays at the edge."""
HALF = 0.36
"""Of a row's height, from its middle to its edge; on a phone the row's name stands above it."""
NARROW_HALF = 0.22
UP, DOWN = "#d55e00", "#009e73"
LINES = ("-", (0, (4, 1.5)), (0, (1.5, 1.5)))
"""Of times: a line a machine."""


class History(NamedTuple):
    """All lines as series, and each series' steps; builds are (date, commit), oldest first."""

    builds: tuple[tuple[str, str], ...]
    series: tuple[Series, ...]
    steps: tuple[Step, ...]

    @property
    def machines(self) -> tuple[str, ...]:
        """Where times were taken."""
        return tuple(dict.fromkeys(one.machine for one in self.series if one.machine))

    @property
    def names(self) -> list[tuple[str, str]]:
        """(what, name) of every benchmark: laws family by family, then engines."""
        named = dict.fromkeys((one.what, one.name) for one in self.series)
        laws = families.in_order(name for what, name in named if what == LAW)
        return [*((LAW, name) for name in laws), *sorted(one for one in named if one[0] != LAW)]

    def of(self, what: str, name: str, measure: str) -> list[Series]:
        """One benchmark's series of a measure: of times one a machine."""
        return [one for one in self.series if (one.what, one.name, one.measure) == (what, name, measure)]

    def steps_of(self, one: Series) -> list[Step]:
        """The steps of a series."""
        return [step for step in self.steps if step.series is one]


@functools.cache
def history() -> History:
    """The history of this checkout."""
    lines = log.read()
    every = tuple(series(lines))
    builds = tuple(dict.fromkeys((line.date, line.commit) for line in lines))
    places = {commit: at for at, (_, commit) in enumerate(builds)}

    def rank(step: Step) -> tuple[int, int, str]:
        return places[step.point.commit], MEASURES.index(step.series.measure), step.series.name

    return History(builds, every, tuple(sorted((step for one in every for step in steps(one)), key=rank)))


@responsive_picture
def chart(given: History, *, narrow=False):
    """Every series about its latest value."""
    names = given.names
    figure, panels = style.panels(1, 3, height=0.8 + (0.4 if narrow else 0.3) * len(names), narrow=narrow)
    places = {name: at for at, (_, name) in enumerate(given.builds)}
    for axes, measure in zip(panels, MEASURES, strict=True):
        axes.set_title((NARROW_TITLES if narrow else TITLES)[measure], fontsize=9.5)
        for row, (what, name) in enumerate(names):
            _draw(axes, given, row, (what, name, measure), places, NARROW_HALF if narrow else HALF)
        _frame(axes, given, len(names), narrow)
    for row, (what, name) in enumerate(names):
        text = _called(what, name)
        if narrow:
            panels[0].text(-0.4, row - 0.45, text, fontsize=7.5, va="center", color=style.INK)
        else:
            panels[0].annotate(
                text, (0.0, row), (-6, 0), xycoords=("axes fraction", "data"), textcoords="offset points",
                ha="right", va="center", fontsize=8.5, annotation_clip=False,
            )  # fmt: skip
    return figure, _words(given)


def _called(what: str, name: str) -> str:
    """What a row is called: a law by its family's word, an engine without the law that it runs."""
    if what == LAW:
        return families.word(name).removesuffix("/zyx-euler")
    return name.replace(" rotation-matrix", "").replace("@", " ")


def _draw(axes, given: History, row: int, key: tuple[str, str, str], places: dict[str, int], half: float) -> None:
    """One cell: its lines, the steps, and the latest value."""
    found = given.of(*key)
    for line, one in zip(itertools.cycle(LINES), found, strict=False):
        last = one.points[-1].value
        heights = [row - half * _height(point.value, last) for point in one.points]
        at = [places[point.commit] for point in one.points]
        if one.measure == TIME:
            low, high = ([row - half * _height(getattr(p, end), last) for p in one.points] for end in ("low", "high"))
            axes.vlines(at, high, low, color=style.MUTED, linewidth=0.8)
        colour = style.look(one.name).colour if one.what == LAW else style.INK
        dot = {"marker": "o", "markersize": 2.2} if one.measure == TIME or len(at) == 1 else {}
        drawn = "default" if one.measure == TIME else "steps-post"
        axes.plot(at, heights, color=colour, linestyle=line, linewidth=1.4, drawstyle=drawn, **dot)
        for step in given.steps_of(one):
            is_more = step.now > step.was
            axes.plot(
                at[step.at], heights[step.at], marker="^" if is_more else "v", color=UP if is_more else DOWN,
                markersize=6, markeredgecolor=style.PAPER, markeredgewidth=0.6, zorder=5,
            )  # fmt: skip
    if found:
        text = _shown(found[0].points[-1], key[2])
        axes.text(len(places) - 0.55, row, text, fontsize=8, va="center", color=style.MUTED)


def _height(value: float, last: float) -> float:
    """How far from the middle of its row a value stands, -1 to 1: by logarithm, so that twice and half are alike."""
    if value <= 0.0 or last <= 0.0:
        return 0.0
    return float(np.clip(np.log(value / last) / np.log1p(BAND), -1.0, 1.0))


def _shown(point: Point, measure: str) -> str:
    return f"{point.value:.2f}" if measure == TIME else number(round(point.value))


def _frame(axes, given: History, rows: int, narrow: bool) -> None:
    builds = len(given.builds)
    axes.set_ylim(rows - 0.2, -0.85 if narrow else -0.6)
    axes.set_xlim(-0.5, builds - 0.5 + (0.75 if narrow else 0.42) * builds)
    axes.set_yticks([])
    axes.set_xticks([])
    axes.grid(visible=False)
    axes.hlines(range(rows), -0.5, builds - 0.5, color=style.GRID, linewidth=0.6, zorder=0)
    first, last = given.builds[0][0][5:10], given.builds[-1][0][5:10]
    for at, day, ha in ((-0.5, first, "left"), (builds - 0.5, last, "right")):
        if ha == "left" or last != first:
            axes.text(at, rows - 0.45, day, ha=ha, va="center", fontsize=7.5, color=style.MUTED)
    for side in ("left", "bottom"):
        axes.spines[side].set_visible(False)


def _words(given: History) -> str:
    first, last = given.builds[0], given.builds[-1]
    changed = "; ".join(
        f"{step.series.name}, {step.series.measure}, at {step.point.commit[:SHORT]}: {step.says}"
        for step in given.steps
    )
    return (
        f"Flops, instructions and time a tick of {len(given.names)} laws and engines over {len(given.builds)} builds, "
        f"{first[0][:10]} to {last[0][:10]}. Steps: {changed or 'none'}."
    )
