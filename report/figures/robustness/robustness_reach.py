"""How far each law goes along each axis of trouble before it gives way: one map, laws by axes.

A law gives way at the first level, walking away from no trouble, at which LOST fewer of the starts go well than without
trouble, or at which its median settling time is more than SLOWED of what it was. A law from which less than half of the
starts go well without any trouble has nothing to lose: it fails.
"""

from __future__ import annotations

import functools
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
from matplotlib.patches import Rectangle

import tasks
from bench.tables import read
from bench.tables.statistics import quantile
from report.figures.kit import families, html, style
from report.figures.kit.inline import responsive_picture
from report.figures.robustness import robustness_rows
from report.figures.robustness.robustness_words import listed

LOST, SLOWED = 0.05, 1.5
TIMELESS = (*robustness_rows.LASTING, "half-turn-noise")
"""Axes along which only the share counts: of what never ends, and of what waits at the half turn."""

SPLIT = 7
"""Columns of the upper half on a phone."""

PAGES = {
    "control-rate": "17-control-rate.md",
    "delay": "18-delay.md",
    "attitude-noise": "19-noise.md",
    "rate-noise": "19-noise.md",
    "half-turn-noise": "20-half-turn-noise.md",
    "saturation": "21-saturation.md",
    "inertia": "22-inertia.md",
    "uneven-inertia": "22-inertia.md",
    "spin": "23-spin.md",
    "moving-goal": "24-moving-goals.md",
    "moving-goal-rate": "24-moving-goals.md",
    "moving-goal-untold": "24-moving-goals.md",
}
"""Axis -> the page about it."""

FAULT, FINE = "#d55e00", "#b9c3cf"


class Walk(NamedTuple):
    """One way along one axis.

    title: over the column, with its unit. words: in a sentence. outwards: towards larger levels, or smaller ones.
    """

    axis: str
    title: str
    words: str
    outwards: bool = True


WALKS: tuple[Walk, ...] = (
    Walk("control-rate", "slow control [Hz]", "slow control", outwards=False),
    Walk("delay", "delay [s]", "delay"),
    Walk("attitude-noise", "attitude noise [rad]", "noise on the orientation"),
    Walk("rate-noise", "rate noise [rad/s]", "noise on the rate"),
    Walk("half-turn-noise", "half-turn noise [rad]", "the worst noise at the half turn"),
    Walk("saturation", "bound [rad/s²]", "a bound on the command", outwards=False),
    Walk("inertia", "lighter body", "a lighter body", outwards=False),
    Walk("inertia", "heavier body", "a heavier body"),
    Walk("uneven-inertia", "uneven body", "an uneven body"),
    Walk("spin", "spin [rad/s]", "initial spin"),
    Walk("moving-goal", "moving goal, all told [rad/s]", "a moving goal of which all is told"),
    Walk("moving-goal-rate", "its rate told [rad/s]", "a moving goal of which the rate is told"),
    Walk("moving-goal-untold", "untold [rad/s]", "a moving goal of which nothing is told"),
)


class Reach(NamedTuple):
    """How far a law goes: the level at which it gives way, None if at none, and which step of how many that is.

    fails: it has nothing to lose, and no level.
    """

    level: float | None
    step: int
    steps: int
    fails: bool = False


def reach(rows: pd.DataFrame, law: str, walk: Walk) -> Reach:
    """Of one law along one way.

    Args:
        rows: of `robustness_rows.along`.
    """
    start = robustness_rows.nominal(tasks.axis(walk.axis))
    there = [x for x in robustness_rows.levels(rows) if (x > start if walk.outwards else x < start)]
    path = there if walk.outwards else there[::-1]
    share, time = _at(robustness_rows.of(rows, law, start))
    if share < 0.5:
        return Reach(None, 0, len(path), fails=True)
    for step, level in enumerate(path):
        good, median = _at(robustness_rows.of(rows, law, level))
        if good < share - LOST or (walk.axis not in TIMELESS and median > SLOWED * time):
            return Reach(level, step, len(path))
    return Reach(None, len(path), len(path))


def _at(rows: pd.DataFrame) -> tuple[float, float]:
    return float(rows["good"].mean()), float(quantile(rows["time_s"].to_numpy(), 0.5))


def rows_of(name: str) -> pd.DataFrame:
    """An axis's rows, read once a page."""
    return _rows_of(name, read.folder())


@functools.cache
def _rows_of(name: str, _: Path) -> pd.DataFrame:
    return robustness_rows.along(name)


def reaches() -> dict[str, list[Reach]]:
    """law -> how far it goes along each way; laws family by family."""
    found: dict[str, list[Reach]] = {}
    for walk in WALKS:
        rows = rows_of(walk.axis)
        for law in robustness_rows.laws(rows):
            found.setdefault(law, []).append(reach(rows, law, walk))
    return found


@responsive_picture
def overview(found: dict[str, list[Reach]], narrow: bool):
    """A cell a law and way: empty where nothing gives way, else the level at which it does.

    Args:
        found: of `reaches`.
    """
    groups = families.present(found)
    lines = len(found) + 0.4 * len(groups)
    parts = [slice(0, SPLIT), slice(SPLIT, None)] if narrow else [slice(None)]
    figure, grid = style.panels(len(parts), 1, height=(0.215 * lines + 1.75) * len(parts), narrow=narrow, squeeze=False)
    for axes, part in zip(grid.flat, parts, strict=True):
        _cells(axes, groups, found, part)
    said = (
        f"{families.word(law)} gives way to {gives_way(found[law]) or 'nothing'}"
        for family in groups
        for law in family.laws
    )
    return figure, f"How far {len(found)} laws go along {len(WALKS)} ways into trouble: {'; '.join(said)}."


def _cells(axes, groups, found: dict[str, list[Reach]], part: slice) -> None:
    walks, place, names = WALKS[part], 0.0, []
    for family in groups:
        place += 0.4
        for law, word in family.laws.items():
            label = families.word(law) if word.startswith("in ") else word
            names.append((place, label, style.look(law).colour))
            for column, one in enumerate(found[law][part]):
                _cell(axes, column, place, one)
            place += 1.0
    axes.set(xlim=(0, len(walks)), ylim=(place + 0.1, 0.2))
    axes.set_xticks(np.arange(len(walks)) + 0.5, [walk.title for walk in walks], rotation=40, ha="left", fontsize=9)
    axes.xaxis.tick_top()
    axes.set_yticks([y + 0.5 for y, _, _ in names], [label for _, label, _ in names], fontsize=9)
    axes.tick_params(length=0, pad=2)
    axes.grid(visible=False)
    for spine in axes.spines.values():
        spine.set_visible(False)


def _cell(axes, column: int, place: float, one: Reach) -> None:
    depth = 1.0 if one.fails else 1.0 - one.step / max(1, one.steps)
    colour, strength = (
        (FINE, 0.35) if _is_fine(one) else (style.MUTED, 0.5) if one.fails else (FAULT, 0.25 + 0.6 * depth)
    )
    axes.add_patch(Rectangle((column + 0.03, place + 0.05), 0.94, 0.9, color=colour, alpha=strength, linewidth=0))
    word = "" if _is_fine(one) else "fails" if one.fails else f"{one.level:g}".removeprefix("0")
    axes.text(column + 0.5, place + 0.52, word, ha="center", va="center", fontsize=8)


def gives_way(own: list[Reach]) -> str:
    """The ways along which a law gives way, with the levels, in words."""
    parts = [
        f"{walk.words} ({'fails' if one.fails else f'at {one.level:g}'})"
        for walk, one in zip(WALKS, own, strict=True)
        if not _is_fine(one)
    ]
    return ", ".join(parts)


def facts(found: dict[str, list[Reach]]) -> dict:
    """Of the overview; laws that are no negative controls."""
    laws = [law for law in found if law not in families.CONTROLS]
    hurt = [sum(not _is_fine(found[law][i]) for law in laws) for i in range(len(WALKS))]
    told = hurt[:-1]  # a goal that moves untold escapes every law
    count = {law: sum(not _is_fine(one) for one in found[law][:-1]) for law in laws}
    fewest, most = min(count.values()), max(count.values())
    harmless = [walk.words for walk, number in zip(WALKS, hurt, strict=True) if not number]
    return {
        "laws": len(laws),
        "axes": len(PAGES),
        "lost": f"{100 * LOST:g}",
        "slowed": f"{SLOWED:g}",
        "held_deg": f"{np.degrees(robustness_rows.HELD_RAD):g}",
        "starts": int(rows_of("delay").groupby(["contender", "level"], observed=True).size().max()),
        "episodes": sum(len(rows_of(name)) for name in PAGES),
        "best": listed(families.word(law) for law in laws if count[law] == fewest),
        "fewest": fewest,
        "weakest": listed(families.word(law) for law in laws if count[law] == most),
        "most": most,
        "harmless": listed(harmless) if harmless else "nothing",
        "hardest": listed(walk.words for walk, number in zip(WALKS, told, strict=False) if number == max(told)),
        "hardest_n": max(told),
        "untold_n": hurt[-1],
    }


def _is_fine(one: Reach) -> bool:
    return one.level is None and not one.fails


def axes_table() -> html.Markdown:
    """An axis a row: its page, what it is, its levels."""
    lines = []
    for name, page in PAGES.items():
        axis = tasks.axis(name)
        unit = "" if axis.unit == "1" else f" {axis.unit.replace('^2', '²')}"
        levels = ", ".join(map(robustness_rows.plain, axis.levels))
        lines.append({"Axis": f"[{axis.title}]({page})", "Levels": f"{levels}{unit}"})
    return html.table(pd.DataFrame(lines))
