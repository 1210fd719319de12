"""Why a law does what it does: a sentence for each thing found of it, with the state that shows it and its page.

A fault is a sentence that names one. Equilibria away from the goal, and places where the command is no number, are no
faults of a law whose `property` is "almost global": the word says that they exist.
"""

import math
import tomllib
from collections.abc import Iterable
from pathlib import Path

import numpy as np
import pandas as pd

import tasks
from bench.experiments.tables.read import with_contender
from bench.experiments.tables.statistics import quantile
from bench.findings.judgement import Said
from bench.findings.perturbed import WITHSTANDS, by_level, thresholds
from bench.findings.selection.needs import CHATTER
from bench.findings.theory.thresholds import near_goal
from bench.law.contenders.registry import contenders

FAILURES, SIDE = "02-three-regulators", "appendix-side-by-side"
ENDS, ROBUSTNESS = "appendix-method", "08-delay-noise-limits"

SENTENCES: dict[str, dict[str, dict[str, str]]]
SENTENCES = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
"""Finding -> what -> text, page and, if it is one, fault."""

SETS = {"every": "every 180° rotation ({found} of {of} axes tried)", "plane": "180° rotations about axes in one plane"}
SETS |= {f"plane-{axis}": f"180° rotations about axes normal to {axis}" for axis in "xyz"}

MOST, NEAR_RAD = 3, 0.01
"""Laws shown beside it. From 180°: what lies nearer, a law that is "almost global" may lose; Paielli and
Bach's does, to 0.005 rad."""

FAULTS = {"oscillating": "oscillation", "creeping": "creeping", "stuck": "stuck"}
FAULTS |= {"crashed": "raises or exits", "hung": "does not return"}
"""Fault by outcome; starts of any other outcome are called lost."""


def sentences(rows: pd.DataFrame, declared: str) -> list[Said]:
    """Return what its rows of command-field.parquet say of a law; declared: its `property`."""
    if rows.empty:
        return [Said("Its command was not looked at: it crashed or hung.", FAILURES, "broken")]
    whats, said = dict(zip(rows["finding"].astype(str), rows["what"].astype(str), strict=True)), []
    if whats["dead-half-turns"] != "none" == whats["no-number-half-turns"] and whats["jump-half-turns"] == "jump":
        whats["dead-half-turns"] = "between"
    if declared == "global with memory" and whats["jump-half-turns"] == "jump":
        whats["jump-half-turns"] = "kept"
    for row, (finding, what) in zip(rows.to_dict("records"), whats.items(), strict=True):
        known = SENTENCES[finding].get(what) or SENTENCES[finding].get("*" if what != "none" else "")
        if known is not None:
            is_excused = finding in ("dead-half-turns", "no-number-half-turns") and what != "between"
            is_declared = is_excused and declared.startswith("almost global")
            fault = "" if is_declared else known.get("fault", "")
            said.append(Said(known["text"].format(**describe_row(row)), known["page"], fault))
    return said


def ends(rows: pd.DataFrame, declared: str) -> list[Said]:
    """How its episodes by one engine end: settled a of b, the first start of each other outcome, and how it rests."""
    is_settled, sets = rows["outcome"] == "settled", rows["start_set"].astype(str)
    each = (f"{name} {own.sum():,} of {len(own):,}" for name, own in is_settled.groupby(sets, sort=False))
    said = [Said(f"Settled: {', '.join(each)}.", ENDS)]
    is_known = (rows["angle0_rad"] > math.pi - NEAR_RAD) & declared.startswith("almost global")
    lost = rows[~is_settled]
    for (known, outcome), own in lost.groupby([is_known, lost["outcome"].astype(str)], sort=False):
        text = f"Not settled, {outcome}: {_counts(own)}."
        said.append(Said(text, FAILURES, "" if known else FAULTS.get(outcome, "lost starts")))
    settled = rows[is_settled]
    chatters, quiet = settled[settled["rest_change"] > CHATTER], settled[settled["rest_change"] <= CHATTER]
    change = f"at rest its command changes by {settled['rest_change'].max():.3g} rad/s² from tick to tick"
    if len(chatters):
        said.append(Said(f"Chatter: {change}, over {CHATTER:g}: {_counts(chatters)}.", ENDS, "chatter"))
    elif len(quiet):
        said.append(Said(f"Quiet: {change}.", ENDS))
    uniform = quiet[quiet["start_set"] == "uniform"]
    long_way = uniform[uniform["path_ratio"] * uniform["angle0_rad"] > math.pi]
    if 2 * len(long_way) > len(uniform):
        text = f"Unwinding: it turns by more than 180 deg from {_counts(long_way)}; {len(uniform)} settle."
        said.append(Said(text, SIDE, "unwinding"))
    return said


def head_lost(name: str, rows: pd.DataFrame, reason: str) -> str:
    """Return a law's name and, if it crashes or hangs, why, from what share of its starts, and from which angle on."""
    lost = rows[rows["outcome"].isin(("crashed", "hung"))] if reason and len(rows) else rows[:0]
    if lost.empty:
        return f"{name}: {reason}" if reason else name
    share, nearest = f"{len(lost) / len(rows):.0%} of {len(rows):,}", math.degrees(lost["angle0_rad"].min())
    return f"{name}: {reason}, from {share} starts, the nearest at {nearest:.3g} deg"


def perturbed(rows: pd.DataFrame) -> list[Said]:
    """State up to which level the law withstands each perturbation, and what closed forms say of it."""
    if rows.empty:
        return []
    gains = float(rows["kp"].iloc[0]), float(rows["kv"].iloc[0])
    [found] = thresholds(with_contender(by_level(rows))).values()
    whole = [f"{way.name} {one.held:g}" for way, one in found.items() if one.is_whole]
    parts = []
    for way, one in found.items():
        if not one.is_whole:
            limit, unit = near_goal(way.axis, way.grows, *gains), tasks.axis(way.axis).unit
            theory = f"; theory near the goal, for every law: {limit:.3g}" if limit == limit else ""
            held = "none" if math.isnan(one.held) else f"{one.held:g}"
            parts.append(f"{way.name} {held} {unit} ({one.share:.0%} at {one.broken:g}{theory})")
    text = f"Thresholds: {'; '.join(parts)}. " if parts else ""
    text += f"Withstood to the last level tried: {', '.join(whole)}." if whole else ""
    return [Said(f"{text.strip()} A threshold is where {WITHSTANDS.partition(';')[0]}.", ROBUSTNESS)]


def beside(field: pd.DataFrame, episodes: pd.DataFrame, run_field: pd.DataFrame, run: pd.DataFrame) -> pd.DataFrame:
    """Return a law and the MOST laws of a run nearest to it, a line each, from the starts that both ran.

    Near is the pull at 90 degrees [kp], and the median settling time as a logarithm; run: by the law's own engine.
    """
    lines, pulls = [_line(field, episodes)], dict(iter(run_field.groupby("contender")))
    for name, own in run[run["start_id"].isin(episodes["start_id"])].groupby(run["contender"].astype(str), sort=False):
        regulator = contenders("regulators").get(str(name).partition("/")[0])
        if regulator is not None and not regulator.control and name in pulls:
            lines.append(_line(pulls[name], own))
    laws = pd.DataFrame(lines)
    apart = [(x - x[0]).pow(2).fillna(100.0) for x in (laws["pull at 90 deg"], np.log(laws["median s"]))]
    return laws.iloc[np.argsort(sum(apart), kind="stable")[: MOST + 1]]


def _line(field: pd.DataFrame, rows: pd.DataFrame) -> dict:
    """Return what is shown of a law."""
    settles, sets = rows["outcome"] == "settled", rows["start_set"]
    uniform, times = rows[sets == "uniform"], rows.loc[settles & (sets == "uniform"), "settling_time_s"].to_numpy()
    return {
        "law": str(rows["contender"].iloc[0]),
        **{name: f"{settles[sets == name].sum()}/{(sets == name).sum()}" for name in ("uniform", "half-turn")},
        "median s": round(float(quantile(times, 0.5)), 3) if len(times) else np.nan,
        **{name.replace("_", " "): round(float(uniform[name].median()), 1) for name in ("peak_u", "effort")},
        "pull at 90 deg": round(float(field.loc[field["finding"] == "pull", "value"].iloc[0]), 3),
    }


def _counts(rows: pd.DataFrame) -> str:
    """How many starts of each set, and the first."""
    counts, first = rows["start_set"].astype(str).value_counts(), rows.iloc[0]
    each = ", ".join(f"{count:,} {name}" for name, count in counts.items())
    return f"{each}, as {first['start_id']} (w x y z = {vector(first[f'quat_{part}'] for part in 'wxyz')})"


def describe_row(row: dict) -> dict[str, str]:
    """Return what a sentence may name, in words."""
    found, of, what = row["found"], row["of"], str(row["what"])
    goal = tuple(row[f"goal_quat_{part}"] for part in "wxyz")
    return {
        **{name: f"{row[name] + 0.0:.3g}" for name in ("value", "least", "most")},
        **{"what": what, "found": f"{found:,}", "of": f"{of:,}"},
        "set": SETS.get(what, "{found} of {of} 180° rotations tried").format(found=found, of=of),
        "at_goal": "at R_d = I" if goal[0] == 1.0 else f"at R_d = {vector(goal)} (w x y z)",
        "state": _state([row[f"quat_{part}"] for part in "wxyz"]),
        "u": f"{vector([row[f'u_{axis}'] for axis in 'xyz'])} rad/s²",
    }


def _state(quat_wxyz: list[float]) -> str:
    """Return an orientation as a turn from the goal I: its angle and axis."""
    w, *v = (math.copysign(1.0, quat_wxyz[0]) * part for part in quat_wxyz)
    size = math.hypot(*v)
    return f"{math.degrees(2.0 * math.atan2(size, w)):.7g} deg about {vector(part / (size or 1.0) for part in v)}"


def vector(numbers: Iterable) -> str:
    """Return some numbers in brackets."""
    return f"({', '.join(f'{number + 0.0:.4g}' for number in numbers)})"
