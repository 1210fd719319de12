"""The page that opens the chapter on robustness: up to which level each law withstands each perturbation."""

import functools
import math
from collections.abc import Iterator

import numpy as np
import pandas as pd

import tasks
from bench.experiments.tables.run import Run, require_rows, with_contender
from bench.findings.amounts import capitalize
from bench.findings.perturbed import (
    FEWEST,
    FOLLOWED_RAD,
    LOST,
    Direction,
    Threshold,
    by_level,
    studied,
    thresholds,
    went_well,
)
from bench.findings.theory import robustness_theory
from bench.findings.theory.thresholds import HALF_TURN
from report.figures.kit import families, html
from report.figures.kit.laws import gains
from report.figures.kit.page import in_run

AXES = tuple(tasks.axis_names())

WEAKER = html.PageTable("Law | Perturbation | Threshold of this law | Threshold of the other laws")

Found = dict[str, dict[Direction, Threshold]]


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
    return require_rows(each, "perturbation")


def compared(each: Found) -> list[str]:
    """Return the laws whose thresholds are compared: no negative control, and none that always fails."""
    return [
        law for law in each if law not in families.CONTROLS and any(one.held == one.held for one in each[law].values())
    ]


def differing(each: Found) -> list[Direction]:
    """Return the directions along which thresholds of the compared laws differ."""
    every = dict.fromkeys(
        direction for thresholds_of_law in each.values() for direction in thresholds_of_law
    )
    differ = []
    for direction in every:
        texts = {str(each[law][direction]) for law in compared(each)}
        if len(texts) > 1:
            differ.append(direction)
    return differ


def facts(run: Run) -> dict:
    """Return how many laws and perturbations there are, how they differ, and limits of the linear loop."""
    each = found(run)
    apart = [_name_direction(direction).lower() for direction in differing(each)]
    # noise at 180° is drawn on the page on what an error must do
    directions = [direction for direction in differing(each) if direction.axis != HALF_TURN]
    groups = group_alike(each, directions)
    kp, kv = gains(along(run, "delay"))
    return {
        "limit": f"{robustness_theory.least_rate(kp, kv):g}",
        "margin_ms": f"{1000.0 * robustness_theory.delay_margin(kp, kv):.0f}",
        "laws": len([law for law in each if law not in families.CONTROLS]),
        "axes": len(AXES),
        "lost": f"{100 * LOST:g}",
        "fewest": f"{100 * FEWEST:g}",
        "held_deg": f"{np.degrees(FOLLOWED_RAD):g}",
        "starts": int(counted(run, "delay")["starts"].max()),
        "run_starts": starts(along(run, "delay")),
        "apart": "; ".join(apart) or "none",
        "alike": len(groups[0]),
        "compared": len(compared(each)),
        "weaker": WEAKER(list_weaker(groups, each, directions))
        or "All laws have the same thresholds.",
        "weaker_finding": describe_weaker(groups, each, directions),
    }


def group_alike(each: Found, directions: list[Direction]) -> list[list[str]]:
    """Return the compared laws in groups of equal thresholds, the largest group first."""
    groups: dict[tuple[str, ...], list[str]] = {}
    for law in compared(each):
        texts = tuple(str(each[law][direction]) for direction in directions)
        groups.setdefault(texts, []).append(law)
    return sorted(groups.values(), key=len, reverse=True)


def list_weaker(
    groups: list[list[str]], each: Found, directions: list[Direction]
) -> Iterator[tuple[str, ...]]:
    """Return a row for every threshold that differs from the threshold of the largest group."""
    usual, *others = groups
    for law in (law for alike in others for law in alike):
        for direction in directions:
            threshold, common = each[law][direction], each[usual[0]][direction]
            if str(threshold) != str(common):
                name = families.link(law, families.word(law))
                title = capitalize(_title(direction))
                yield name, title, _with_unit(threshold, direction), _with_unit(common, direction)


def describe_weaker(groups: list[list[str]], each: Found, directions: list[Direction]) -> str:
    """Say how many laws have other thresholds than the largest group, and for how many perturbations."""
    usual, *others = groups
    laws = [law for alike in others for law in alike]
    if not laws:
        return f"All {len(usual)} laws have the same thresholds"
    common = each[usual[0]]
    apart: dict[str, list[Direction]] = {law: [] for law in laws}
    is_less = True
    for law in laws:
        for direction in directions:
            threshold = each[law][direction]
            if str(threshold) != str(common[direction]):
                apart[law].append(direction)
                is_less = is_less and _is_less(threshold, common[direction], direction)
    verbs = ("have other thresholds", "has other thresholds")
    if is_less:
        verbs = ("withstand only milder levels", "withstands only milder levels")
    counts = sorted({len(directions_of_law) for directions_of_law in apart.values()})
    number = f"{counts[0]} to {counts[-1]}" if len(counts) > 1 else f"{counts[0]}"
    verb = verbs[len(laws) == 1]
    each_law = " each" if len(laws) > 1 else ""
    return (
        f"{len(laws)} of the {len(laws) + len(usual)} laws {verb} than the other laws, for {number} "
        f"of the perturbations{each_law}"
    )


def _is_less(threshold: Threshold, common: Threshold, direction: Direction) -> bool:
    """Tell whether a threshold is milder than another one; no level at all is the mildest."""
    if math.isnan(threshold.held):
        return True
    return threshold.held < common.held if direction.grows else threshold.held > common.held


def _name_direction(direction: Direction) -> str:
    """Return the title of a perturbation, with its direction."""
    return tasks.axis(direction.axis).title + ("" if direction.grows else " (decreasing)")


def _title(direction: Direction) -> str:
    """Return what a perturbation is called in a sentence, with its direction."""
    title = _name_direction(direction)
    return f"{title[0].lower()}{title[1:]}"


def _with_unit(threshold: Threshold, direction: Direction) -> str:
    """Return a threshold with its unit, and whether the last level that was tried is withstood."""
    if math.isnan(threshold.held):
        return "no level"
    unit = tasks.axis(direction.axis).unit
    last = " (last level tried)" if threshold.withstands_all else ""
    return f"{threshold.held:g}{'' if unit == '1' else f' {unit}'}{last}"
