"""The page that opens the chapter on robustness: how far each law goes along each perturbation before it degrades.

A law degrades at the first level, walking away from none, at which LOST fewer of the starts go well than unperturbed,
or at which its median settling time is more than SLOWED of what it was. A law from which less than half of the starts
go well without any perturbation has nothing to lose: it fails.
"""

from __future__ import annotations

import functools
from typing import NamedTuple

import numpy as np
import pandas as pd
from matplotlib.patches import Rectangle

from bench.findings.maps import lost_share
from bench.findings.perturbed import FOLLOWED_RAD, by_level, lasting, studied
from bench.tables.read import with_contender
from report.figures.kit import families, style
from report.figures.kit.inline import responsive_picture
from report.figures.kit.page import Run, given
from report.figures.robustness.rows import along, laws, levels, listed, nominal, of, starts

LOST, SLOWED = 0.05, 1.5
TIMELESS = (*lasting(), "half-turn-noise")
"""Perturbations under which only the share counts: that never end, or that wait at the half turn."""


class Walk(NamedTuple):
    """One way along one perturbation.

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
    Walk("moving-goal", "moving goal [rad/s]", "a moving goal with full feedforward"),
    Walk("moving-goal-rate", "only rate fed [rad/s]", "a moving goal with feedforward of its rate"),
    Walk("moving-goal-untold", "no feedforward", "a moving goal without feedforward"),
)

AXES = tuple(dict.fromkeys(walk.axis for walk in WALKS))

SPLIT = 7
"""Columns of the upper half on a phone."""

FAULT, FINE = "#d55e00", "#b9c3cf"


class Reach(NamedTuple):
    """The level at which a law degrades, None if at none; fails: it has nothing to lose, and no level.

    depth: 1 if at the first level, the less the farther it goes.
    """

    level: float | None = None
    depth: float = 0.0
    fails: bool = False


@functools.cache
def counted(run: Run, axis: str) -> pd.DataFrame:
    """`by_level` of one perturbation: of the study's starts for the laws that it has, of the run's for others."""
    rows = along(run, axis)
    if rows.empty:
        return rows
    known = studied()
    known = known[(known["axis"] == axis) & known["contender"].isin(laws(rows))]
    own = rows[~rows["contender"].isin(set(known["contender"]))]
    return pd.concat([known, with_contender(by_level(own))]) if len(own) else known


def reach(rows: pd.DataFrame, law: str, walk: Walk) -> Reach:
    """Of one law along one way, in rows of `counted`."""
    start = nominal(walk.axis)
    path = [x for x in levels(rows) if x > start] if walk.outwards else [x for x in levels(rows)[::-1] if x < start]
    at = {one["level"]: (one["good"] / one["starts"], one["median_s"]) for _, one in of(rows, law).iterrows()}
    share, time = at[start]
    if share < 0.5:
        return Reach(fails=True)
    for step, level in enumerate(path):
        good, slower = at[level]
        if good < share - LOST or (walk.axis not in TIMELESS and slower > SLOWED * time):
            return Reach(level, 1.0 - step / len(path))
    return Reach()


def widest(starts: int) -> float:
    """The most that a share of so many starts lies off an end of its exact interval: where half of them are lost."""
    one = lost_share(starts // 2, starts)
    return max(one.high - one.value, one.value - one.low)


def is_fine(one: Reach) -> bool:
    """Whether a law degrades nowhere."""
    return one.level is None and not one.fails


@functools.cache
def reaches(run: Run) -> dict[str, list[Reach]]:
    """law -> how far it goes along each way; laws family by family."""
    found: dict[str, list[Reach]] = {}
    for walk in WALKS:
        for law in laws(along(run, walk.axis)):
            found.setdefault(law, []).append(reach(counted(run, walk.axis), law, walk))
    return found


def facts(run: Run) -> dict:
    """How many laws degrade under each perturbation, without the negative controls."""
    found = reaches(run)
    own = [law for law in found if law not in families.CONTROLS]
    if not own:
        return {}
    hurt = [sum(not is_fine(found[law][i]) for law in own) for i in range(len(WALKS))]
    avoidable = hurt[:-1]  # without feedforward every law loses a moving goal
    harmless = [walk.words for walk, number in zip(WALKS, hurt, strict=True) if not number]
    hardest = [walk.words for walk, number in zip(WALKS, avoidable, strict=False) if number == max(avoidable)]
    return {
        "laws": len(own),
        "axes": len(AXES),
        "lost": f"{100 * LOST:g}",
        "slowed": f"{SLOWED:g}",
        "held_deg": f"{np.degrees(FOLLOWED_RAD):g}",
        "starts": int(counted(run, "delay")["starts"].max()),
        "width": f"{100 * widest(int(counted(run, 'delay')['starts'].max())):.0f}",
        "run_starts": starts(along(run, "delay")),
        "harmless": listed(harmless) if harmless else "nothing",
        "hardest": listed(hardest),
        "hardest_n": max(avoidable),
        "no_feedforward": hurt[-1],
    }


def figures(run: Run) -> dict:
    """Which law degrades under what."""
    return {"robustness": given(reaches(run), reach_map)}


@responsive_picture
def reach_map(found: dict[str, list[Reach]], narrow: bool):
    """A cell a law and way, as found by `reaches`: empty where it does not degrade, else the level at which it does."""
    groups = families.present(found)
    lines = len(found) + 0.4 * len(groups)
    parts = [slice(0, SPLIT), slice(SPLIT, None)] if narrow else [slice(None)]
    figure, grid = style.panels(len(parts), 1, height=(0.215 * lines + 1.75) * len(parts), narrow=narrow, squeeze=False)
    for axes, part in zip(grid.flat, parts, strict=True):
        _cells(axes, groups, found, part)
    words = (
        f"{families.word(law)} degrades under {degrading(found[law]) or 'nothing'}"
        for family in groups
        for law in family.laws
    )
    told = f"How far {len(found)} laws go along {len(AXES)} perturbations, inertia both ways"
    return figure, f"{told}: {'; '.join(words)}."


def _cells(axes, groups, found: dict[str, list[Reach]], part: slice) -> None:
    walks, place, names = WALKS[part], 0.0, []
    for family in groups:
        place += 0.4
        for law in family.laws:
            names.append((place + 0.5, families.word(law)))
            for column, one in enumerate(found[law][part]):
                _cell(axes, column, place, one)
            place += 1.0
    axes.set(xlim=(0, len(walks)), ylim=(place + 0.1, 0.2))
    axes.set_xticks(np.arange(len(walks)) + 0.5, [walk.title for walk in walks], rotation=40, ha="left", fontsize=9)
    axes.xaxis.tick_top()
    axes.set_yticks(*zip(*names, strict=True), fontsize=9)
    axes.tick_params(length=0, pad=2)
    axes.grid(visible=False)
    axes.spines[:].set_visible(False)


def _cell(axes, column: int, place: float, one: Reach) -> None:
    colour, strength = (
        (FINE, 0.35) if is_fine(one) else (style.MUTED, 0.5) if one.fails else (FAULT, 0.25 + 0.6 * one.depth)
    )
    axes.add_patch(Rectangle((column + 0.03, place + 0.05), 0.94, 0.9, color=colour, alpha=strength, linewidth=0))
    word = "" if is_fine(one) else "fails" if one.fails else f"{one.level:g}".removeprefix("0")
    axes.text(column + 0.5, place + 0.52, word, ha="center", va="center", fontsize=8)


def degrading(own: list[Reach]) -> str:
    """The perturbations under which a law degrades, with the levels, in words."""
    parts = [
        f"{walk.words} ({'fails' if one.fails else f'at {one.level:g}'})"
        for walk, one in zip(WALKS, own, strict=True)
        if not is_fine(one)
    ]
    return ", ".join(parts)
