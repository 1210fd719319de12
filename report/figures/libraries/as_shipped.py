"""Controllers as their authors ship them: what is felt of what is set, where they rest, and the smallest fix."""

import math
from collections.abc import Callable
from typing import Any

import pandas as pd

from bench.base.files import read_json
from bench.experiments.shipped import BENT_DEG, FELT_RAD
from bench.experiments.tables.run import Run
from bench.findings.amounts import count, count_of
from bench.findings.libraries import RESTATED
from bench.findings.remedy import KEEP, fix_of
from bench.law.contenders.registry import contenders
from bench.law.shipped import POSITION, TORQUE, VELOCITY, AsShipped
from report.figures.kit import html
from report.figures.kit.page import in_run
from report.figures.kit.spelling import power

LEVELS = (TORQUE, POSITION, VELOCITY)
WEAK = 0.75
"""Share of the stiffness set: what feels less feels as half, or as a deadband."""
HOST = "https://github.com"

MEASURED = html.PageTable(
    "Controller | Gains K, D | Stiffness at 0.06°, 3° and 57° [% of K] | Damping ratio:.3g | "
    "Inertia for critical damping [kg m²]:.2g | Starts at 180° that the body never leaves | "
    "Starts with unwinding | Largest change of the command's direction by a clip [°]:.0f | "
    "Settling time from 1°, 90° and 179.9° [s]"
)
FIXES = html.PageTable(
    "Controller | Stiffness at 3° [% of K]:.0f | Starts at 180° that the body never leaves | "
    "Smallest fix | Largest command as shipped → with the fix"
)


def shipped(run: Run) -> pd.DataFrame:
    """Return a row for each controller, torques first."""
    rows = run.rows("shipped")
    rows = rows.astype(dict.fromkeys(("shipped", "law", "level", "shapes_inertia"), str))
    rows["bent"] = rows[[f"bent_{angle}_rad" for angle in BENT_DEG]].max(axis=1)
    own = rows[rows["law"] == ""]
    order = own["level"].map(LEVELS.index)
    return own.assign(order=order).sort_values(["order", "shipped"], ignore_index=True)


def is_weak(own: pd.DataFrame) -> pd.Series:
    """Find controllers with much less than the stiffness set at 3°; a limit of speed is none."""
    return (own["stiffness_50mrad"] < WEAK) & (own["level"] != VELOCITY)


FACTS: dict[str, Callable[[pd.DataFrame], object]] = {
    "weak_ratio": lambda own: f"{own.loc[is_weak(own), 'damping_ratio'].max():.3g}",
    "dead_names": lambda own: named(own[own["dead"] > 0]),
    "bent": lambda own: count_of(int((own["bent"] > 0.0).sum()), len(own), "controllers"),
    "bent_most": lambda own: f"{math.degrees(own['bent'].max()):.0f}",
    "unsettled": lambda own: named(own[own["settling_1_s"].isna() & (own["starts"] > 0)]),
    "away": lambda own: count_of(int((own["away"] > 0).sum()), int((own["starts"] > 0).sum()), "controllers"),
    "starts": lambda own: int(own["starts"].max()),
    "measured": lambda own: MEASURED(in_lines(own)),
}
"""What the text says, of one line a controller; and what is measured, equals in one line."""


def facts(run: Run) -> dict:
    """Return what the text says of controllers, of fixes and of the study that held them to their sources."""
    return held() | (in_run(lambda: {key: make(shipped(run)) for key, make in FACTS.items()}) or {})


def held() -> dict:
    """Return what the study found that held each controller to its source."""
    restated = read_json(RESTATED)["controllers"]
    built = [one for one in restated if "difference" in one]
    fixes = {name: fix_of(name) for name in contenders("shipped")}
    rises = [name for name, fix in fixes.items() if fix.after > 1.01 * fix.before]
    return {
        "fixed": count(sum(fix.words != KEEP for fix in fixes.values()), "controller"),
        "kept": count(sum(fix.words == KEEP for fix in fixes.values()), "controller"),
        "rises": ", ".join(rises) or "none",
        "built": count_of(len(built), len(restated), "controllers"),
        "pairs": power(max(one["pairs"] for one in built)),
        "difference": power(max(one["difference"] for one in built)),
    }


def named(rows: pd.DataFrame) -> str:
    """Names, or none."""
    return ", ".join(rows["shipped"]) or "none"


def in_lines(rows: pd.DataFrame) -> list[tuple]:
    """Return a row for all controllers with the same cells."""
    lines: dict[tuple, list[str]] = {}
    for one in rows.itertuples():
        lines.setdefault(measured(one), []).append(link(contenders("shipped")[one.shipped]))
    return [(", ".join(names), *cells) for cells, names in lines.items()]


def measured(one: Any) -> tuple:
    """Return the cells of a controller but for its name."""
    has_body, times = one.starts > 0, (one.settling_1_s, one.settling_90_s, one.settling_179_9_s)
    settled = html.no_break(
        ", ".join("never" if math.isnan(time) else f"{time:.2g}" for time in times)
    )
    return (
        f"{one.kp:.3g}, {one.kv:.3g}" if has_body else f"{one.kp:.3g} per period",
        html.no_break(", ".join(f"{100.0 * getattr(one, name):.0f}" for name in FELT_RAD)),
        one.damping_ratio if has_body else None,
        None if math.isnan(one.critical) else one.critical,
        stuck(one),
        (f"{one.away} of {one.starts}" if one.away else "none") if has_body else None,
        math.degrees(one.bent),
        settled if has_body else None,
    )


def stuck(row: Any) -> str:
    """Return at how many 180° rotations a controller stays."""
    if row.dead in (0, row.half_turns):
        return "all" if row.dead else "none"
    return f"{row.dead} of {row.half_turns}"


def link(one: AsShipped) -> str:
    """Return a controller's name as a link to its source, at the revision that was restated."""
    source, _, revision = one.source.partition("@")
    return f"[{one.name}]({HOST}/{source}/blob/{revision}/{one.path.partition(',')[0]})"


def reported(thread: str, words: str = "") -> str:
    """Return a thread upstream, owner/repository#number, as a link; pull requests are found under it too."""
    repository, _, number = thread.partition("#")
    return f"[{words or f'#{number}'}]({HOST}/{repository}/issues/{number})" if thread else html.MISSING


def describe_fix(row: Any) -> tuple:
    """Return the cells of a controller's fix: what is felt, what to change, the greatest command before and after."""
    one, found = contenders("shipped")[row.shipped], fix_of(row.shipped)
    known = f" Public thread: {reported(one.thread)}." if one.thread else ""
    unit = "rad/s²" if one.shapes_inertia else "N m"
    return (
        link(one),
        100.0 * row.stiffness_50mrad,
        stuck(row),
        found.words + known,
        html.no_break(f"{found.before:.3g} → {found.after:.3g} {unit}"),
    )
