"""Controllers as their authors ship them: what is felt of what is set, where they rest, and what to write instead."""

from __future__ import annotations

import math
from collections.abc import Callable

import pandas as pd

from bench.contenders.registry import known_shipped
from bench.findings.claims.verdict import NoEvidence
from bench.findings.selection import needs
from bench.law.shipped import POSITION, TORQUE, VELOCITY
from bench.tables.shipped_columns import BENT_DEG, FELT_RAD
from report.figures.kit import html, laws
from report.figures.kit.page import Run, given
from report.figures.kit.tables import Table

LEVELS = (TORQUE, POSITION, VELOCITY)
WEAK = 0.75
"""Of the stiffness set: what feels less feels as half, or as a deadband."""
RIGHT = 0.99
LIGHT = 0.1
"""Inertia [kg m^2] for which a damping ratio is said, besides that of 1: a hand with a tool about its centre."""
HOST = "https://github.com"

MEASURED = Table(
    "Controller | K, D | Felt [%] | Damping ratio:.3g | Critical at [kg m²]:.2g | Rests at 180° | Unwinds "
    "| Bent [°]:.0f | Settles [s] | Instead [s]"
)
SOURCES = Table("Controller | What, and where | Audit | Write instead")


def advised(run: Run) -> str | None:
    """The law that is advised where nothing else is known; None if this run cannot tell."""
    try:
        return needs.advice(run.folder).default.law
    except NoEvidence:
        return None


def shipped(run: Run) -> pd.DataFrame:
    """A row a controller, torques first; `ours_...` of the advised law in its place, null where there is none."""
    rows = run.rows("shipped")
    if rows.empty:
        return rows
    rows = rows.astype(dict.fromkeys(("shipped", "law", "level", "shapes_inertia", "findings"), str))
    rows["bent"] = rows[[f"bent_{angle}_rad" for angle in BENT_DEG]].max(axis=1)
    own, ours = rows[rows["law"] == ""], rows[rows["law"] == (advised(run) or "none")]
    own = own.merge(ours.add_prefix("ours_"), how="left", left_on="shipped", right_on="ours_shipped")
    order = own["level"].map(LEVELS.index)
    return own.assign(order=order).sort_values(["order", "shipped"], ignore_index=True)


def is_weak(own: pd.DataFrame) -> pd.Series:
    """Controllers that feel much less than the stiffness set at 3°; a limit of speed is none."""
    return (own["stiffness_50mrad"] < WEAK) & (own["level"] != VELOCITY)


FACTS: dict[str, Callable[[pd.DataFrame], object]] = {
    "controllers": len,
    "weak": lambda own: int(is_weak(own).sum()),
    "weak_ratio": lambda own: f"{own.loc[is_weak(own), 'damping_ratio'].max():.3g}",
    "dead": lambda own: int((own["dead"] > 0).sum()),
    "dead_names": lambda own: named(own[own["dead"] > 0]),
    "half_turns": lambda own: int(own["half_turns"].max()),
    "bent": lambda own: int((own["bent"] > 0.0).sum()),
    "bent_most": lambda own: f"{math.degrees(own['bent'].max()):.0f}",
    "unsettled": lambda own: named(own[own["settling_1_s"].isna() & (own["starts"] > 0)]),
    "away": lambda own: int((own["away"] > 0).sum()) or "none",
    "starts": lambda own: int(own["starts"].max()),
    "heaviest": lambda own: named(heaviest(own)),
    "light": lambda own: LIGHT,
    "light_ratio": lambda own: f"{heaviest(own)['damping_ratio'].max() / math.sqrt(LIGHT):.2g}",
}
"""What the text says, of one line a controller."""


def facts(run: Run) -> dict:
    """The conclusion, and what the text says of inertia."""
    own = shipped(run)
    return {key: given(own, make) for key, make in FACTS.items()} | {"ours": in_place(own, advised(run))}


def heaviest(own: pd.DataFrame) -> pd.DataFrame:
    """Those whose inertia is not cancelled, damped critically at the largest inertia."""
    return own[own["critical"] >= own["critical"].max() * RIGHT]


def in_place(own: pd.DataFrame, law: str | None) -> str | None:
    """What the advised law has of all this at the same gains."""
    if law is None or own.empty:
        return None
    theirs = own[own["starts"] > 0]
    wrong = int(theirs[["ours_dead", "ours_lost", "ours_away", "ours_bent"]].gt(0.0).any(axis=1).sum())
    has = f"has some of this at the gains of {wrong}" if wrong else "has none of this at the same gains"
    return f"{laws.title(law)} {has}"


def named(rows: pd.DataFrame) -> str:
    """Names, or none."""
    return ", ".join(rows["shipped"]) or "none"


def tables(run: Run) -> dict:
    """What is measured, equals in one line; where it comes from, and what to write instead."""
    own, law = shipped(run), advised(run)
    lines: dict[tuple, list[str]] = {}
    for one in own.itertuples():
        lines.setdefault(measured(one, law), []).append(one.shipped)
    return {
        "measured": MEASURED((", ".join(names), *cells) for cells, names in lines.items()),
        "sources": SOURCES(
            (one.shipped, described(one.shipped), one.findings or "nothing", instead(one, law))
            for one in own.itertuples()
        ),
    }


def measured(one, law: str | None) -> tuple:
    """A controller's cells but for its name; law: the one that is advised."""
    has_body = one.starts > 0
    return (
        f"{one.kp:.3g}, {one.kv:.3g}" if has_body else f"{one.kp:.3g} a tick",
        html.together(", ".join(f"{100.0 * getattr(one, name):.0f}" for name in FELT_RAD)),
        one.damping_ratio if has_body else None,
        None if math.isnan(one.critical) else one.critical,
        "every" if one.dead == one.half_turns else f"{one.dead} of {one.half_turns}" if one.dead else "no",
        (f"{one.away} of {one.starts}" if one.away else "no") if has_body else None,
        math.degrees(one.bent),
        times(one.settling_1_s, one.settling_90_s, one.settling_179_9_s) if has_body else None,
        times(one.ours_settling_1_s, one.ours_settling_90_s, one.ours_settling_179_9_s) if law and has_body else None,
    )


def times(*settling: float) -> str:
    """Settling times [s]."""
    return html.together(", ".join("never" if math.isnan(one) else f"{one:.2g}" for one in settling))


def instead(one, law: str | None) -> str | None:
    """One sentence: what to write in a controller's place, and what that changes."""
    if one.level == VELOCITY and not one.bent and not one.dead:
        return "Keep its error: direction and dead points are right."
    changes = []
    if one.level != VELOCITY and one.stiffness_50mrad < RIGHT:
        changes.append(f"all of K is felt, {1.0 / one.stiffness_50mrad:.3g} times as much as now")
    if not one.stiffness_1mrad:
        changes.append("it moves inside the deadband too")
    if one.dead:
        changes.append("it leaves every 180° rotation")
    if one.bent:
        changes.append("its direction is kept")
    if not changes:
        return "Keep it: nothing that is looked at is wrong."
    if law is None:
        return None
    if one.shapes_inertia == "no":
        changes.append(f"critical at {one.ours_critical:.2g} kg m²")
    return f"`bench export {law} --to cpp`, same K and D: {'; '.join(changes)}."


def described(name: str) -> str | None:
    """Title, source at its commit by the first of the files that were read, and where the gains are set."""
    if name not in known_shipped():
        return None
    one = known_shipped()[name]
    repository, _, revision = one.source.partition("@")
    where = f"{HOST}/{repository}/blob/{revision}/{one.path.partition(',')[0]}"
    return f"{one.title} ([{revision[:8]}]({where}); gains: {one.set_by})"
