"""The page that opens the chapter on robustness: up to which level each law withstands each perturbation."""

import functools
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.patches import Rectangle

import tasks
from bench.experiments.tables.read import with_contender
from bench.findings.claims.tables import some
from bench.findings.perturbed import FOLLOWED_RAD, LOST, Threshold, Way, by_level, studied, thresholds, went_well
from bench.findings.theory import robustness_theory
from bench.findings.theory.thresholds import HALF_TURN
from report.figures.kit import families, style
from report.figures.kit.inline import Drawing, responsive_picture
from report.figures.kit.laws import gains
from report.figures.kit.page import Run, in_run

AXES = tuple(tasks.axis_names())

FAULT, FINE = style.FAULT, style.FINE

Found = dict[str, dict[Way, Threshold]]


@functools.cache
def along(run: Run, name: str) -> pd.DataFrame:
    """Return rows of one perturbation, by family, with `good`."""
    rows = run.rows("robustness", axis=name)
    names = families.in_order(rows["contender"].unique())
    return rows.assign(
        contender=pd.Categorical(rows["contender"].astype(str), names, ordered=True),
        good=went_well(rows),
    )


def laws(rows: pd.DataFrame, controls: bool = True) -> list[str]:
    """Return the laws of the rows, family by family; without the negative controls if so asked."""
    names = [name for name in rows["contender"].cat.categories if (rows["contender"] == name).any()]
    return names if controls else [name for name in names if name not in families.CONTROLS]


def starts(rows: pd.DataFrame) -> int:
    """Return the starts of a law at a level."""
    return int(rows.groupby(["contender", "level"], observed=True).size().max())


@functools.cache
def counted(run: Run, axis: str) -> pd.DataFrame:
    """`by_level` of one perturbation: of the study's starts for the laws that it has, of the run's for others."""
    rows = along(run, axis)
    known = studied()
    known = known[(known["axis"] == axis) & known["contender"].isin(laws(rows))]
    own = rows[~rows["contender"].isin(set(known["contender"]))]
    return pd.concat([known, with_contender(by_level(own))]) if len(own) else known


@functools.cache
def found(run: Run) -> Found:
    """Return every law's thresholds, laws family by family."""
    each: Found = {}
    for axis in AXES:
        known = in_run(lambda axis=axis: thresholds(counted(run, axis)))
        for law in laws(along(run, axis)) if known else ():
            each.setdefault(law, {}).update(known[law])
    return some(each, "perturbation")


def compared(each: Found) -> list[str]:
    """Return the laws whose thresholds are compared: no negative control, and none that always fails."""
    return [
        law for law in each if law not in families.CONTROLS and any(one.held == one.held for one in each[law].values())
    ]


def differing(each: Found) -> list[Way]:
    """Return the ways along which thresholds of the compared laws differ."""
    every = dict.fromkeys(way for own in each.values() for way in own)
    return [way for way in every if len({str(each[law][way]) for law in compared(each)}) > 1]


def facts(run: Run) -> dict:
    """Return how many laws and perturbations there are, how they differ, and limits of the linear loop; and the map."""
    each = found(run)
    apart = [tasks.axis(way.axis).title.lower() + " (downwards)" * (not way.grows) for way in differing(each)]
    kp, kv = gains(along(run, "delay"))
    return {
        "limit": f"{robustness_theory.least_rate(kp, kv):g}",
        "margin_ms": f"{1000.0 * robustness_theory.delay_margin(kp, kv):.0f}",
        "laws": len([law for law in each if law not in families.CONTROLS]),
        "axes": len(AXES),
        "lost": f"{100 * LOST:g}",
        "held_deg": f"{np.degrees(FOLLOWED_RAD):g}",
        "starts": int(counted(run, "delay")["starts"].max()),
        "run_starts": starts(along(run, "delay")),
        "apart": "; ".join(apart) or "none",
        "robustness": threshold_map(each),
    }


@responsive_picture
def threshold_map(each: Found, narrow: bool) -> Drawing:
    """Return a cell for each threshold, pale where it is the last level tried; laws that are alike share a row."""
    ways = [way for way in differing(each) if way.axis != HALF_TURN]  # drawn on the page on what an error must do
    rows = group_alike(each, ways)
    figure, axes = style.panels(height=0.26 * len(rows) + 1.5, narrow=narrow)
    for place, laws_alike in enumerate(rows):
        for column, way in enumerate(ways):
            _cell(axes, column, place, each[laws_alike[0]][way])
    titles = [f"{way.name} [{tasks.axis(way.axis).unit}]" for way in ways]
    stand = {"rotation": 90, "ha": "center"} if narrow else {"rotation": 40, "ha": "left", "rotation_mode": "anchor"}
    axes.set(xlim=(0, max(1, len(ways))), ylim=(len(rows), 0))
    axes.set_xticks(np.arange(len(ways)) + 0.5, titles, fontsize=9, **stand)
    axes.xaxis.tick_top()
    axes.set_yticks(np.arange(len(rows)) + 0.5, map(name_alike, rows), fontsize=9)
    axes.tick_params(length=0, pad=2)
    axes.grid(visible=False)
    axes.spines[:].set_visible(False)
    words = (f"{name_alike(one)}: {', '.join(f'{w.name} {each[one[0]][w]}' for w in ways)}" for one in rows)
    return figure, f"Thresholds of {len(each)} laws; + is the last level tried. {'; '.join(words)}."


def group_alike(each: Found, ways: list[Way]) -> list[list[str]]:
    """Return the compared laws in groups of equal thresholds, the largest group first."""
    groups: dict[tuple[str, ...], list[str]] = {}
    for law in compared(each):
        groups.setdefault(tuple(str(each[law][way]) for way in ways), []).append(law)
    return sorted(groups.values(), key=len, reverse=True)


def name_alike(alike: list[str]) -> str:
    """Return the names of two laws and fewer, or how many laws there are."""
    return ", ".join(map(families.word, alike)) if len(alike) < 3 else f"{len(alike)} laws"


def _cell(axes: Any, column: int, place: float, one: Threshold) -> None:
    is_none = one.held != one.held
    colour, strength = (FINE, 0.35) if one.is_whole and not is_none else (style.MUTED, 0.5) if is_none else (FAULT, 0.4)
    axes.add_patch(Rectangle((column + 0.03, place + 0.05), 0.94, 0.9, color=colour, alpha=strength, linewidth=0))
    axes.text(column + 0.5, place + 0.52, str(one), ha="center", va="center", fontsize=8)
