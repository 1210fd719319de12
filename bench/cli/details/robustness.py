"""Robustness: up to which level each law withstands each perturbation, beside the closed forms."""

import math
from collections.abc import Iterator

import pandas as pd

import tasks
from bench.cli.details.episodes import OF_STARTS, settled
from bench.experiments.tables.run import with_contender
from bench.findings.perturbed import WITHSTANDS, by_level, thresholds
from bench.findings.theory.thresholds import HALF_TURN, least, near_goal

NEAR = "(theory near the goal)"
FEW = 3
"""Perturbations up to which each has a table of its own."""


def tables(rows: pd.DataFrame) -> Iterator[tuple[str, pd.DataFrame]]:
    """Thresholds; of few perturbations one more table for each."""
    if rows.empty:
        return
    table = summary(rows)
    laws = table[(table["law"] != NEAR) & ~(table == "none").sum(axis=1).gt(FEW)]
    alike = [one for one in table.columns[2:] if laws[one].nunique() == 1 and table.shape[1] > FEW + 2]
    title = f"robustness, thresholds ({OF_STARTS}; threshold: {WITHSTANDS})"
    if alike:
        levels = ", ".join(f"{one} {laws[one].iloc[0]}" for one in alike)
        title += f"\nalike for all laws that settle unperturbed: {levels}"
    yield title, table.drop(columns=alike)
    axes = sorted(rows["axis"].unique())
    for axis in axes if len(axes) <= FEW else ():
        own = with_contender(by_level(rows[rows["axis"] == axis])).astype({"contender": str})
        cells = own.assign(well=own["good"].astype(str) + "/" + own["starts"].astype(str))
        shown = cells.pivot(index="contender", columns="level", values="well").rename(columns="{:g}".format)
        shown = shown.loc[own["contender"].unique()].rename_axis("law").rename_axis(None, axis=1).reset_index()
        yield f"{axis} [{tasks.axis(axis).unit}], level by level (a/b: a of b starts go well)", shown


def summary(rows: pd.DataFrame) -> pd.DataFrame:
    """One line for each law and one of theory near the goal: a threshold for each way, theory's at 180° beside it."""
    named = with_contender(rows)
    kp, kv = float(rows["kp"].iloc[0]), float(rows["kv"].iloc[0])
    found = thresholds(with_contender(by_level(named)))
    tried = list(dict.fromkeys(way for own in found.values() for way in own))
    theory = {"law": NEAR, "settled": ""}
    theory |= {way.name: form(near_goal(way.axis, way.grows, kp, kv)) for way in tried}
    lines = [theory]
    for law, own in found.items():
        line = {"law": law, "settled": settled(named[named["contender"] == law])}
        line |= {way.name: str(own[way]) if way in own else "" for way in tried}
        if any(way.axis == HALF_TURN for way in tried):
            line[f"{HALF_TURN}, theory"] = form(least(law, kp, kv))
        lines.append(line)
    return pd.DataFrame(lines).fillna("")


def form(value: float) -> str:
    """Return a number of a closed form; empty where there is none."""
    return "" if math.isnan(value) else f"{value:.3g}"
