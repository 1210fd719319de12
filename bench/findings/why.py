"""Why a law does what it does: a sentence for each thing found of it, with its subject and the state that shows it.

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
from bench.audit.faults.stiffness import UNITS
from bench.experiments.command_field import EXCHANGED
from bench.experiments.tables.run import with_contender
from bench.experiments.tables.statistics import quantile
from bench.findings.amounts import count_of, join_words
from bench.findings.judgement import Sentence
from bench.findings.perturbed import WITHSTANDS, by_level, thresholds
from bench.findings.subjects import SentenceSubject
from bench.findings.theory.thresholds import near_goal
from bench.law.contenders.registry import contenders
from bench.law.kinds import CONTROL
from bench.running.sandbox.sandbox import MOST_LOST, STRETCH
from tasks.rules import RULES

CHATTER = 1.0
"""Largest change of the command from tick to tick at rest [rad/s^2]: a hundredth of Kp times a radian. A linear loop
that has just come to rest from 180 degrees changes by (Kp w + Kv (Kp b + Kv w)) dt = 0.25 at most, b = 0.063 rad being
the band and w = b/0.25 s."""

SENTENCES: dict[str, dict[str, dict[str, str]]]
SENTENCES = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
"""Finding -> what -> text, subject and, if it is one, fault."""

SETS = {
    "every": "180° rotations about all {of} axes that we tried",
    "plane": "180° rotations about axes in one plane",
    "some": "180° rotations about {found} of the {of} axes that we tried",
}
SETS |= {f"plane-{axis}": f"180° rotations about axes normal to {axis}" for axis in "xyz"}

MOST, NEAR_RAD = 3, 0.01
"""Laws shown beside it. From 180°: what lies nearer, a law that is "almost global" may lose; Paielli and
Bach's does, to 0.005 rad."""

EVERYWHERE = ("zero", "no-number")
"""Causes that are one thing in every state."""

AT_GOAL = ("goal", "stiffness", "damping")
SAID_WITH = {"exchanged": ("stiffness", "damping")}
"""Findings that are said where one fault explains the rest; exchanged components explain what is wrong at the goal."""

UNIT_RELATIVE = 1e-3
"""Share by which a stiffness may differ from that of another unit: no gain is set better than to a thousandth."""

FAULTS = {"oscillating": "oscillation", "creeping": "creeping", "stuck": "stuck"}
FAULTS |= {"crashed": "raises or exits", "hung": "does not return"}
"""Fault by outcome; starts of any other outcome are called lost."""


def sentences(
    rows: pd.DataFrame, declared: str, cause: str = "", stiffness: tuple[float, ...] = (1.0, 1.0, 1.0)
) -> list[Sentence]:
    """Return what its rows of command-field.parquet say of a law; declared, stiffness: as its file has them.

    cause: the fault that explains all others (`find_cause`); then only it and what is known of the goal are said.
    """
    if rows.empty:
        return [
            Sentence(
                "Its command was not looked at: it crashed or hung.",
                SentenceSubject.LOST_STARTS,
                "broken",
            )
        ]
    whats = find_words(rows, declared)
    if whats["stiffness"] == "as-set" and len(set(stiffness)) > 1:
        whats["stiffness"] = "by-axis"
    about_axes = {"declared": join_words([f"{share:g}" for share in stiffness])}
    if cause in EVERYWHERE:
        return [_say(SENTENCES["everywhere"][cause], {})]
    said = []
    for row, (finding, what) in zip(rows.to_dict("records"), whats.items(), strict=True):
        known = SENTENCES[finding].get(what) or SENTENCES[finding].get("*" if what != "none" else "")
        if known is None or (cause and finding not in SAID_WITH.get(cause, AT_GOAL)):
            continue
        is_excused = finding in ("dead-half-turns", "no-number-half-turns") and what != "between"
        is_declared = is_excused and declared.startswith("almost global")
        said.append(_say(known, describe_row(row) | about_axes, is_fault=not is_declared))
    return said


def find_words(rows: pd.DataFrame, declared: str) -> dict[str, str]:
    """Return the word of each finding of a law, as SENTENCES has it: some words follow from several findings."""
    whats = dict(zip(rows["finding"].astype(str), rows["what"].astype(str), strict=True))
    is_jump = whats["jump-half-turns"] == "jump"
    # sign(0) taken as 0 makes a law with two sides dead on the whole border between them, not at single places
    is_border = whats["dead-half-turns"].startswith(("every", "plane"))
    if is_border and is_jump and whats["no-number-half-turns"] == "none":
        whats["dead-half-turns"] = "between"
    if declared == "global with memory" and is_jump:
        whats["jump-half-turns"] = "kept"
    if whats["stiffness"].startswith(EXCHANGED):
        whats["stiffness"] = "exchanged"
    if whats["stiffness"] == "scaled" and find_unit(_value_of(rows, "stiffness"))[0]:
        whats["stiffness"] = "unit"
    return whats


def find_unit(share: float) -> tuple[str, str]:
    """Return the unit of angle whose stiffness is so many times the one of radians, and that number; or two blanks."""
    for times, unit in UNITS.items():
        if abs(share / times - 1.0) <= UNIT_RELATIVE:
            return unit
    return "", ""


def find_cause(rows: pd.DataFrame, has_memory: bool) -> str:
    """Return the word of the fault that explains whatever episodes of a law would show; empty if there is none.

    The command field shows a law at its first tick. That of a law with memory need not be its last word:
    quaternion-unwinding first drives away from the goal, and settles.
    """
    if rows.empty or has_memory:
        return ""
    whats = dict(zip(rows["finding"].astype(str), rows["what"].astype(str), strict=True))
    [pull] = rows[rows["finding"] == "pull"].to_dict("records")
    is_dead, is_no_number = (whats[finding] == "every" for finding in ("dead-half-turns", "no-number-half-turns"))
    if whats["stiffness"] == whats["damping"] == "none" and is_dead and pull["least"] == pull["most"] == 0.0:
        return "zero"
    if whats["goal"] == "no-number" and is_no_number and math.isnan(pull["value"]):
        return "no-number"
    if whats["stiffness"].startswith(EXCHANGED):
        return "exchanged"
    if whats["stiffness"] in ("wrong-sign", "row-first"):
        return whats["stiffness"]
    return "wrong-damping" if whats["damping"] == "wrong-sign" else ""


def _value_of(rows: pd.DataFrame, finding: str) -> float:
    return float(rows.loc[rows["finding"] == finding, "value"].iloc[0])


def _say(known: dict[str, str], words: dict[str, str], is_fault: bool = True) -> Sentence:
    subject = SentenceSubject(known["subject"])
    return Sentence(
        known["text"].format(**words), subject, known.get("fault", "") if is_fault else ""
    )


def ends(rows: pd.DataFrame, declared: str) -> list[Sentence]:
    """How its episodes by one engine end: settled a of b, the first start of each other outcome, and how it rests."""
    is_settled, sets = rows["outcome"] == "settled", rows["start_set"].astype(str)
    each = (f"{name} {own.sum():,} of {len(own):,}" for name, own in is_settled.groupby(sets, sort=False))
    said = [Sentence(f"Settled: {', '.join(each)}.", SentenceSubject.JUDGE)]
    is_known = (rows["angle0_rad"] > math.pi - NEAR_RAD) & declared.startswith("almost global")
    lost = rows[~is_settled]
    for (known, outcome), own in lost.groupby([is_known, lost["outcome"].astype(str)], sort=False):
        text = f"Not settled, {outcome}: {_counts(own)}."
        fault = "" if known else FAULTS.get(outcome, "lost starts")
        said.append(Sentence(text, SentenceSubject.LOST_STARTS, fault))
    settled = rows[is_settled]
    chatters, quiet = settled[settled["rest_change"] > CHATTER], settled[settled["rest_change"] <= CHATTER]
    change = f"at rest its command changes by {settled['rest_change'].max():.3g} rad/s² from tick to tick"
    if len(chatters):
        text = f"Chatter: {change}, over {CHATTER:g}: {_counts(chatters)}."
        said.append(Sentence(text, SentenceSubject.JUDGE, "chatter"))
    elif len(quiet):
        said.append(Sentence(f"Quiet: {change}.", SentenceSubject.JUDGE))
    uniform = quiet[quiet["start_set"] == "uniform"]
    long_way = uniform[uniform["path_ratio"] * uniform["angle0_rad"] > math.pi]
    if 2 * len(long_way) > len(uniform):
        text = f"Unwinding: it turns by more than 180 deg from {_counts(long_way)}; {len(uniform)} settle."
        said.append(Sentence(text, SentenceSubject.UNWINDING, "unwinding"))
    return said


def describe_lost_starts(name: str, rows: pd.DataFrame, reason: str) -> str:
    """Return a law's name and, if it crashes or hangs, why, and from what share of its starts.

    If the law raised an error at every lost start, also the angle of the nearest. A start that was lost with its
    process has no time of failure: it may be lost only because another start of its stretch was.
    """
    lost = rows[rows["outcome"].isin(("crashed", "hung"))] if reason and len(rows) else rows[:0]
    if lost.empty:
        return f"{name}: {reason}" if reason else name
    text = f"{name}: {reason}, from {len(lost) / len(rows):.0%} of {len(rows):,} starts"
    if lost["failure_time_s"].isna().any():
        return f"{text}; up to {STRETCH} are lost together, and after {MOST_LOST} such losses all that follow"
    nearest = math.degrees(lost["angle0_rad"].min())
    return f"{text}, the nearest at {nearest:.3g} deg"


def is_settling(rows: pd.DataFrame) -> bool:
    """Tell whether some episodes settle that do not begin at the goal."""
    return bool(((rows["outcome"] == "settled") & (rows["angle0_rad"] >= RULES.at_goal_rad)).any())


def not_run(cause: str, episodes: pd.DataFrame, is_lost: bool) -> list[Sentence]:
    """Say what was not run, and why: where a cause is known no episode, where no start settles no perturbation."""
    if cause:
        text = "No episode was run: the fault explains what episodes would show. Correct it first."
        return [Sentence(text, SentenceSubject.JUDGE)]
    if len(episodes) and not is_lost and not is_settling(episodes):
        text = "No perturbation was tried: without one the law settles from no start."
        return [Sentence(text, SentenceSubject.ROBUSTNESS)]
    return []


def perturbed(rows: pd.DataFrame) -> list[Sentence]:
    """State up to which level the law withstands each perturbation, and what closed forms say of it."""
    if rows.empty:
        return []
    gains = float(rows["kp"].iloc[0]), float(rows["kv"].iloc[0])
    [found] = thresholds(with_contender(by_level(rows))).values()
    whole = [
        f"{direction.name} {one.held:g}" for direction, one in found.items() if one.withstands_all
    ]
    parts = []
    for direction, one in found.items():
        if not one.withstands_all:
            limit, unit = (
                near_goal(direction.axis, direction.grows, *gains),
                tasks.axis(direction.axis).unit,
            )
            theory = f"; theory near the goal, for every law: {limit:.3g}" if limit == limit else ""
            held = "none" if math.isnan(one.held) else f"{one.held:g}"
            parts.append(
                f"{direction.name} {held} {unit} ({one.share:.0%} at {one.broken:g}{theory})"
            )
    text = f"Thresholds: {'; '.join(parts)}. " if parts else ""
    text += f"Withstood to the last level tried: {', '.join(whole)}." if whole else ""
    text = f"{text.strip()} A threshold is where {WITHSTANDS.partition(';')[0]}."
    return [Sentence(text, SentenceSubject.ROBUSTNESS)]


def beside(field: pd.DataFrame, episodes: pd.DataFrame, run_field: pd.DataFrame, run: pd.DataFrame) -> pd.DataFrame:
    """Return a law and the MOST laws of a run nearest to it, a line each, from the starts that both ran.

    Near is the pull at 90 degrees [kp], and the median settling time as a logarithm; run: by the law's own engine.
    """
    lines, pulls = [_line(field, episodes)], dict(iter(run_field.groupby("contender")))
    for name, own in run[run["start_id"].isin(episodes["start_id"])].groupby(run["contender"].astype(str), sort=False):
        regulator = contenders("regulators").get(str(name).partition("/")[0])
        if regulator is not None and regulator.role != CONTROL and name in pulls:
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
    unit, unit_number = find_unit(row["value"])
    return {
        **{"order": ", ".join(what.removeprefix(EXCHANGED)), "unit": unit, "unit_number": unit_number},
        **{name: f"{row[name] + 0.0:.3g}" for name in ("value", "least", "most")},
        **{f"times_{gain}": _times(row["value"], gain) for gain in ("kp", "kv")},
        "at_most": f"at most {row['value']:.3g} kp" if row["value"] else "zero",
        "states": count_of(found, of, "states") if found <= of else "",
        **{"what": what, "found": f"{found:,}", "of": f"{of:,}"},
        "set": SETS.get(what, SETS["some"]).format(found=found, of=of),
        "at_goal": "for the goal R_d = I"
        if goal[0] == 1.0
        else f"for the goal with the quaternion (w, x, y, z) = {vector(goal)}",
        "state": _state([row[f"quat_{part}"] for part in "wxyz"]),
        "u": f"{vector([row[f'u_{axis}'] for axis in 'xyz'])} rad/s²",
    }


def _times(share: float, gain: str) -> str:
    """Return a share of a gain in words: the gain itself where it is 1."""
    number = f"{share + 0.0:.3g}"
    return {"1": gain, "-1": f"-{gain}"}.get(number, f"{number} {gain}")


def _state(quat_wxyz: list[float]) -> str:
    """Return an orientation as a turn from the goal I: its angle and axis."""
    w, *v = (math.copysign(1.0, quat_wxyz[0]) * part for part in quat_wxyz)
    size = math.hypot(*v)
    return f"{math.degrees(2.0 * math.atan2(size, w)):.7g} deg about {vector(part / (size or 1.0) for part in v)}"


def vector(numbers: Iterable) -> str:
    """Return some numbers in brackets."""
    return f"({', '.join(f'{number + 0.0:.4g}' for number in numbers)})"
