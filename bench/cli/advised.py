"""What `advise` prints: paragraphs and the table of laws, in the units of the user's kp."""

from __future__ import annotations

import math
from typing import Any

from bench.base.on_first_use import pd
from bench.cli.paragraphs import Paragraph, listed
from bench.cli.screen import counted
from bench.experiments.situations import HORIZON_S, mapped_laws
from bench.findings.selection.advice import Advice, list_unmapped, loop_of
from bench.findings.selection.nearest import Outside
from bench.findings.selection.regions import RULE, TIE, facts_of, find_overshooting, meets_but_overshoot
from bench.findings.selection.words import NAMES
from bench.findings.theory.sampled_loop import StabilityLimits, mode_time
from bench.law.contenders.registry import find_contender
from tasks.situation import COORDINATES, KP

LACKS = {
    "lost": "loses starts",
    "stuck": "stuck at exact 180°",
    "unwound": "unwinds",
    "trapped": "trapped by noise at 180°",
    "overshooting": "overshoots",
}
"""Columns that count what a law must not do, in words."""

NEAR_ONE = 0.01
"""A law that is faster by less than this is not said to be so."""


def paragraphs(advice: Advice, kp: float) -> list[Paragraph]:
    """Return the answer, its price, what closed forms say, and how sure the answer is."""
    unit = 1.0 / math.sqrt(kp)
    where = Paragraph("How sure", tuple(_describe_evidence(advice)))
    if advice.law is None:
        return [Paragraph("Which law", tuple(_describe_none(advice, kp))), where]
    return [
        Paragraph("Which law", (_describe_law(advice, unit),)),
        Paragraph("Price", tuple(_describe_prices(advice, kp))),
        Paragraph("Theory", (_describe_theory(advice, unit),)),
        where,
    ]


def attribution(law: str) -> str:
    """Return whether a law is published, adapted from published work, or ours."""
    return find_contender(law).attribution


def _describe_none(advice: Advice, kp: float) -> list[str]:
    """Say why no law is advised, and what to change."""
    near_goal, unit = advice.near_goal, 1.0 / math.sqrt(kp)
    horizon = HORIZON_S * math.sqrt(KP) * unit
    if near_goal.limits:
        return [
            f"No law: the linear loop near the goal, which is every law's there, is unstable (spectral radius "
            f"{near_goal.radius:.3f} a tick).",
            _describe_limits(near_goal.limits, kp),
        ]
    if near_goal.least > horizon / unit:
        return [
            f"No law: with this bound no law can settle 99 % of the starts in less than {near_goal.least * unit:.3g} "
            f"s, and an episode ends after {horizon:.3g} s. Raise the bound, or lower kp: at a lower kp an episode "
            "is longer."
        ]
    if near_goal.time > horizon / unit:
        loop = loop_of(advice.wanted)
        continuous = mode_time(math.exp(-0.5 * loop.kv), 1.0) if loop.zeta < 1.0 else math.nan
        plain = "" if math.isnan(continuous) else f" ({continuous * unit:.3g} s without sampling, delay and inertia)"
        return [
            f"No law: near the goal every law is a linear loop that needs {near_goal.time * unit:.3g} s to 2 % of an "
            f"error{plain}, and an episode ends after {horizon:.3g} s. The damping ratio is {loop.zeta:.3g}: raise kv "
            f"towards {2.0 * math.sqrt(kp):.3g} 1/s, or lower kp."
        ]
    which = "none of all laws" if advice.is_whole else "no law"
    return [
        f"No law: {which} that were simulated in your situation meets the requirements; the table shows what each "
        "lacks."
    ]


def _describe_limits(limits: StabilityLimits, kp: float) -> str:
    """Say by which change of one number the loop becomes stable."""
    root = math.sqrt(kp)
    cures = []
    if not math.isnan(limits.kv):
        cures.append(
            f"reduce kv below {limits.kv * root:.3g} 1/s at this damping ratio (kp below {limits.kp * kp:.3g} 1/s²)"
        )
    if not math.isnan(limits.kv_low):
        low, high = limits.kv_low * root, limits.kv_high * root
        cures.append(f"keep kv between {low:.3g} and {high:.3g} 1/s at this kp")
    if not math.isnan(limits.kp_alone):
        cures.append(f"reduce kp below {limits.kp_alone * kp:.3g} 1/s² at this kv")
    if not math.isnan(limits.delay):
        cures.append(f"bring the delay below {1e3 * limits.delay / root:.3g} ms")
    if not math.isnan(limits.rate):
        cures.append(f"raise the rate above {limits.rate * root:.4g} Hz")
    text = ", or ".join(cures)
    return f"{text[:1].upper()}{text[1:]}. Each number alone makes the loop just stable; take clearly more."


def _describe_law(advice: Advice, unit: float) -> str:
    """Return the sentence on the law: its time, ties, and faster laws with the reason why they are not advised."""
    row = advice.row(str(advice.law))
    own = (
        f"Use {advice.law} ({attribution(str(advice.law))}): 99 % of the starts settle in {row['time'] * unit:.3f} s "
        f"({row['time_low'] * unit:.3f} to {row['time_high'] * unit:.3f}), simulated in your situation"
    )
    if advice.tied:
        verb = "tie" if len(advice.tied) > 1 else "ties"
        ties = f"{listed(advice.tied)} {verb} within {TIE:.0%}"
    elif len(advice.qualified) > 1:
        ties = f"no other law that was simulated and meets the requirements is within {TIE:.0%}"
    else:
        ties = "no other law that was simulated meets the requirements"
    return "; ".join([own, ties, *_describe_faster(advice, row["time"])]) + "."


def _describe_faster(advice: Advice, time: float) -> list[str]:
    """Return a clause for each law that is faster and is not advised."""
    assert advice.rows is not None
    clauses = []
    for row in with_overshooting(advice.rows).to_dict("records"):
        law, share = str(row["contender"]), row["time"] / time
        if law == advice.law or law in advice.qualified or not share < 1.0 - NEAR_ONE:
            continue
        reasons = _list_lacks(row)
        why = listed(reasons) if reasons else "has not what you require"
        if law in advice.ours:
            why = "is ours and not reviewed"
        clauses.append(f"{law} is {1.0 - share:.0%} faster, but {why}")
    return clauses


def with_overshooting(rows: pd.DataFrame) -> pd.DataFrame:
    """Return the rows with a column of which laws overshoot by more than the rule allows."""
    is_too_far = find_overshooting(rows, meets_but_overshoot(rows), RULE.overshoot)
    return rows.assign(overshooting=is_too_far)


def _list_lacks(row: dict[str, Any]) -> list[str]:
    words = {
        "lost": f"loses {row['lost']} of {row['starts']:,} starts",
        "stuck": "is stuck at exact 180°",
        "unwound": "first turns away from the goal",
        "trapped": "is trapped by noise at 180°",
        "overshooting": f"overshoots by {row['overshoot']:.0f}°",
    }
    return [text for column, text in words.items() if row[column]]


def _describe_prices(advice: Advice, kp: float) -> list[str]:
    """Return the price of the law and of the runner-up; the peak of both is made equal by another kp of the second."""
    own = advice.row(str(advice.law))
    sentences = [f"{advice.law}: {_describe_price(own, kp)}."]
    others = [law for law in advice.qualified if law != advice.law]
    if others:
        other = advice.row(others[0])
        # At equal numbers of the situation times go as 1/sqrt(kp), and commands as kp.
        equal = other["time"] * math.sqrt(other["peak"] / own["peak"] / kp)
        sentences.append(
            f"{others[0]}, the next: {other['time'] / math.sqrt(kp):.3f} s, or {equal:.3f} s if kp were such that its "
            f"greatest command is that of {advice.law}; {_describe_price(other, kp)}."
        )
    return sentences


def _describe_price(row: dict[str, Any], kp: float) -> str:
    memory = facts_of(str(row["contender"])).memory
    kept = counted(memory, "number") if memory else "nothing"
    return (
        f"greatest command {row['peak'] * kp:.4g} rad/s², overshoot {row['overshoot']:.1f}°, keeps {kept} from tick "
        f"to tick, {row['operations']} operations a tick"
    )


def _describe_theory(advice: Advice, unit: float) -> str:
    near_goal = advice.near_goal
    text = (
        f"Near the goal every law is one linear loop: stable (spectral radius {near_goal.radius:.4f} a tick), to 2 % "
        f"in {near_goal.time * unit:.3g} s."
    )
    if near_goal.least:
        text += f" With this bound no law at all can be faster than {near_goal.least * unit:.3f} s."
    if math.isfinite(advice.least):
        text += f" {describe_least(advice, unit)}"
    return text


def describe_least(advice: Advice, unit: float) -> str:
    """Compare the law with the fastest motions that the bound allows."""
    ratio = advice.row(str(advice.law))["time"] / advice.least
    spinning = " that we found" if advice.wanted.spin else ""
    return (
        f"The fastest motions{spinning} with this bound, without delay and control period, settle 99 % of the starts "
        f"in {advice.least * unit:.3f} s; {advice.law} takes {ratio:.2f} times as long."
    )


def _describe_evidence(advice: Advice) -> list[str]:
    """Say which situation this is, where it lies to the map, and what was simulated."""
    sentences = [f"Your situation: {advice.wanted.describe()}."]
    sentences += [describe_outside(number) for number in advice.outside]
    nearest = advice.nearest
    if nearest and nearest.distance == 0.0:
        sentences.append("It is in the map.")
    elif nearest:
        agreeing, of = nearest.agree
        sentences.append(
            f"The nearest of the map: {nearest.at.describe()} (distance {nearest.distance:.2f}); nothing beats its "
            f"law, {nearest.verdict.law or 'none'}, in {agreeing} of the {of} situations next to it."
        )
    if advice.rows is not None:
        sentences.append(_describe_trials(advice))
    if unmapped := list_unmapped():
        sentences.append(_describe_unmapped(unmapped))
    if advice.replaced:
        why = "does not meet the requirements" if advice.lacks else f"is slower by more than {TIE:.0%}"
        sentences.append(f"In your situation {advice.replaced}, the law of the map, {why}.")
    return sentences


def _describe_trials(advice: Advice) -> str:
    assert advice.rows is not None
    starts = advice.rows["starts"]
    every = len(mapped_laws())
    which = f"All {every} laws" if advice.is_whole else f"{len(starts)} of {counted(every, 'law')}"
    more = "" if advice.is_whole else "; --run simulates all"
    return f"{which} were simulated now, from {starts.min():,} to {starts.max():,} of the same starts{more}."


def _describe_unmapped(laws: list[str]) -> str:
    """Name the laws that the map does not have yet, and say how to try them all the same."""
    cure = "--run simulates every law, python -P -m bench.studies.situations makes a new map (an hour)"
    return f"Not in the map yet: {listed(laws)}; {cure}."


def describe_outside(number: Outside) -> str:
    """Say that a number is outside the map, and which range the map has."""
    text = COORDINATES[number.name].text
    value, low = text.format(number.value), text.format(number.low)
    high = "none" if math.isinf(number.high) else text.format(number.high)
    return f"Outside the map: {NAMES[number.name]} {value}, the map has {low} to {high}; no law is taken from it."


def table(advice: Advice, kp: float) -> pd.DataFrame:
    """Return the rows of laws with their numbers at the user's kp, and what each lacks."""
    assert advice.rows is not None
    rows, unit = with_overshooting(advice.rows), 1.0 / math.sqrt(kp)
    laws = rows["contender"].astype(str).tolist()
    lacks = []
    for row in rows.to_dict("records"):
        lacks.append("; ".join(word for column, word in LACKS.items() if row[column]))
    ratios = rows["time"] / advice.least
    compared = {} if math.isnan(advice.least) else {"over least": ratios.map("{:.2f}".format)}
    return pd.DataFrame(
        {
            "law": [f"{law} ({attribution(law)})" for law in laws],
            "99 % [s]": (rows["time"] * unit).map("{:.3f}".format),
            **compared,
            "peak [rad/s^2]": (rows["peak"] * kp).map("{:.4g}".format),
            "overshoot [deg]": rows["overshoot"].map("{:.1f}".format),
            "memory": [facts_of(law).memory for law in laws],
            "operations": rows["operations"],
            "starts": rows["starts"],
            "lacks": lacks,
        }
    )
