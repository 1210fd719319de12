"""Controllers as their authors ship them: what is felt of what is set, where they rest, and what to write instead."""

from __future__ import annotations

import math
from collections.abc import Callable

import pandas as pd

from bench.contenders.registry import known_shipped
from bench.findings.claims.verdict import NoEvidence
from bench.findings.selection import needs
from bench.law.shipped import POSITION, TORQUE, VELOCITY, Shipped
from bench.tables.shipped_columns import BENT_DEG, FELT_RAD
from report.figures.kit import laws
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
    "| Bent [°]:.0f | Settles [s] | Instead [s] | Write instead"
)
SOURCES = Table("Controller | Source | K and D set by | Audit of the error | Besides, not restated")


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
    """Titles, or none."""
    return "; ".join(map(title, rows["shipped"])) or "none"


def title(name: str) -> str:
    """Of a controller; its name if it is no longer known."""
    return known_shipped()[name].title if name in known_shipped() else name


def tables(run: Run) -> dict:
    """What is measured, and where it comes from."""
    own, law = shipped(run), advised(run)
    return {
        "measured": MEASURED(map(measured(law), own.itertuples())),
        "sources": SOURCES(map(sourced, own.itertuples())),
    }


def sourced(one) -> tuple:
    """Where a controller is from; of one that is no longer there, its name."""
    source = known_shipped().get(one.shipped)
    if source is None:
        return (one.shipped, None, None, one.findings, None)
    return (source.title, link(source), source.set_by, one.findings or "nothing", source.besides or None)


def measured(law: str | None):
    """A controller's line, with the law that is advised."""

    def line(one) -> tuple:
        has_body = one.starts > 0
        return (
            title(one.shipped),
            f"{one.kp:.3g}, {one.kv:.3g}" if has_body else f"{one.kp:.3g} a tick",
            ", ".join(f"{100.0 * getattr(one, name):.0f}" for name in FELT_RAD),
            one.damping_ratio if has_body else None,
            one.critical,
            "every" if one.dead == one.half_turns else f"{one.dead} of {one.half_turns}" if one.dead else "no",
            (f"{one.away} of {one.starts}" if one.away else "no") if has_body else None,
            math.degrees(one.bent),
            ", ".join(map(seconds, (one.settling_1_s, one.settling_90_s, one.settling_179_9_s))) if has_body else None,
            ", ".join(map(seconds, (one.ours_settling_1_s, one.ours_settling_90_s, one.ours_settling_179_9_s)))
            if law and has_body
            else None,
            instead(one, law),
        )

    return line


def seconds(time: float) -> str:
    """A settling time."""
    return "never" if math.isnan(time) else f"{time:.2g}"


def instead(one, law: str | None) -> str | None:
    """One sentence: what to write in a controller's place, and what that changes."""
    if one.level == VELOCITY and not one.bent and not one.dead:
        return "Keep its error: direction and dead points are right."
    changes = []
    if one.level != VELOCITY and one.stiffness_50mrad < RIGHT:
        changes.append(f"all of K is felt, {1.0 / one.stiffness_50mrad:.2g} times as much as now")
    if not one.stiffness_1mrad:
        changes.append("it moves inside the deadband too")
    if one.dead:
        changes.append("it leaves every 180° rotation")
    if one.bent:
        changes.append("no clip bends it")
    if not changes:
        return "Keep it: nothing that is looked at is wrong."
    if law is None:
        return None
    if one.shapes_inertia == "no":
        changes.append(f"critical at {one.ours_critical:.2g} kg m²")
    return f"`bench export {law} --to cpp`, same K and D: {'; '.join(changes)}."


def link(one: Shipped) -> str:
    """The source at its commit, and the first of the files that were read."""
    repository, _, revision = one.source.partition("@")
    first = one.path.partition(",")[0]
    return f"[{repository} at {revision[:8]}]({HOST}/{repository}/blob/{revision}/{first})"
