"""The page that says which law to use: in which situation, by which criteria."""

from __future__ import annotations

import math

import pandas as pd

from bench.experiments.tables.statistics import Estimate
from bench.findings.claims import Results, judge
from bench.findings.claims.adequacy import HELD_RAD
from bench.findings.claims.standing import MEASURABLE
from bench.findings.selection import gains, needs
from bench.findings.selection.criteria import BY_NAME, Criterion
from bench.findings.selection.measured import Measured, measured
from bench.findings.selection.robots import ROBOTS, word_of
from bench.findings.selection.words import cost, faster_under_a_bound, standing, together
from report.figures.kit import families, html
from report.figures.kit.page import Run


def shown(found: Measured) -> list[str]:
    """Return all laws but the negative controls."""
    return [law for law in found.laws if law not in families.CONTROLS]


def facts(run: Run) -> dict:
    """Return the advice in a few sentences, and the numbers about it."""
    found = measured(run.folder)
    whole = [law for law in shown(found) if needs.EVERYWHERE.has(found, law)]
    forgetful = [law for law in shown(found) if not found.number("memory", law) and law in found.values["held"]]
    return {
        "lead": lead(run),
        "same": "; ".join(one.need.words for one in needs.advice(run.folder).others) or "none",
        "laws": len(shown(found)),
        "tried": sum(needs.TRIED.has(found, law) for law in shown(found)),
        "whole": len(whole),
        "unheld": sum(needs.UNHELD.has(found, law) for law in whole),
        "uniform": len(found.values["time"][found.laws[0]]),
        "directed": len(found.tables.directed) // len(found.laws),
        "perturbed": max(map(len, found.values["bounded"].values()), default=0),
        "noise": f"{HELD_RAD:g}",
        "measurable": f"{100 * MEASURABLE:g}",
        "band": f"{100 * float(found.tables.uniform['tolerance'].iloc[0]):g}",
        "forgetful": len(forgetful),
        "forgetful_both": sum(needs.has_all(found, law, (needs.EVERYWHERE, needs.UNHELD)) for law in forgetful)
        or "none",
        "verdict": str(judge("C27", Results(run.folder)).word),
    }


def front_page(run: Run) -> str:
    """Return the advice in a few words."""
    found, one = measured(run.folder), needs.advice(run.folder).default
    if one.law is None:
        return f"No law of this run settles from every start tried and is trapped by no noise up to {HELD_RAD:g} rad."
    rest = (standing(one, families.word), faster_under_a_bound(found, one.law, families.word), _ours(found))
    word, time = families.word(one.law), told(BY_NAME["time"], found.estimate("time", one.law))
    return (
        f"{word[0].upper()}{word[1:]}, a published law, at {gains.gains_in_words(found)}, in simulation only: it "
        f"settles from every start tried, even an adversary who falsifies the measured orientation by up to "
        f"{HELD_RAD:g} rad cannot hold the body at 180°, and 99 % of all starts settle in {time}. "
        f"{' '.join(filter(None, rest))}"
    )


def _ours(found: Measured) -> str:
    """Our own law compared with the advised one at each damping ratio; empty where the run has no law of ours."""
    own = gains.ours(found)
    if own is None:
        return ""
    return (
        f"Our own law beside it is {families.word(own)}: 2026, simulation only, not reviewed. "
        f"{gains.compare_at_all_gains(families.word)} Reset its memory when the goal jumps, which was not tested here."
    )


def lead(run: Run) -> str:
    """Return the front page's answer, the cost of a tick, and in how many situations another law is better."""
    advice = needs.advice(run.folder)
    if advice.default.law is None:
        return front_page(run)
    return (
        f"{front_page(run)} A tick takes {cost(measured(run.folder), advice.default.law)}. In {len(advice.others)} of "
        f"{len(advice.exceptions) + len(advice.others)} situations no published law is "
        f"better by more than {needs.MATTERS:.0%}."
    )


def tables(run: Run) -> dict:
    """Return what to use by what a robot takes, and by situation."""
    found = measured(run.folder)
    return {
        "robots": by_robot(run),
        "decided": decided(needs.advice(run.folder), found),
    }


def by_robot(run: Run) -> html.Markdown:
    """Return a line for each thing that a robot may take: the law to use, with whom it ties, the rows that say so."""
    lines = []
    for robot in ROBOTS:
        one = word_of(robot, run.folder)
        cells = {"If your robot takes": robot.takes}
        if one is None:
            cells["use"] = "not in this run"
        elif one.law is None:
            cells["use"] = "no law of this run"
        else:
            tied = [families.word(law) for law in one.tied]
            cells |= {
                "use": families.link(one.law, families.word(one.law)),
                "Tied with": together(tied) if tied else "",
            }
            cells["Of laws"] = str(len(one.asked))
        lines.append(cells | {"Measured": html.Html(f'<a href="{robot.page}.html">{robot.rows}</a>')})
    return html.table(pd.DataFrame(lines).fillna(""))


def decided(advice: needs.Advice, found: Measured) -> html.Markdown:
    """Return a line a situation: the law to use, its numbers and the default's, and with what it ties."""
    usual = advice.default.law
    lines = [_line(one, usual, found) for one in (advice.default, *advice.exceptions)]
    return html.table(pd.DataFrame(lines).fillna(""))


def _line(one: needs.Decision, usual: str | None, found: Measured) -> dict:
    words = {"If": one.need.words}
    if one.law is None:
        return {**words, "use": "no law of this run"}
    cells = {**words, "use": families.link(one.law, families.word(one.law)), "It has": _has(one, one.law, found)}
    if usual and one.need is not needs.DEFAULT:
        has = _has(one, usual, found) if usual in one.asked else "not this"
        cells[f"{families.word(usual)} has".capitalize()] = has
    return cells | {"Tied with": together([families.word(law) for law in one.tied]) if one.tied else ""}


def _has(one: needs.Decision, law: str, found: Measured) -> str:
    """Format a law's estimate by each of a situation's criteria, named where they are several."""
    parts = [(BY_NAME[name], found.estimate(name, law)) for name in one.need.by]
    named = [f"{criterion.title.lower()}: " if len(parts) > 1 else "" for criterion, _ in parts]
    return "; ".join(name + told(*part) for name, part in zip(named, parts, strict=True))


def told(criterion: Criterion, number: Estimate) -> str:
    """Return a number with its unit, and its interval where it has one."""
    value, low, high = (written(criterion, part) for part in number)
    span = "" if value == low == high else f" ({low} to {high})"
    return f"{value} {criterion.unit}{span}" if criterion.unit else f"{value}{span}"


def written(criterion: Criterion, value: float) -> str:
    """Return a number as its criterion writes it."""
    if math.isnan(value):
        return html.MISSING
    if math.isinf(value):
        return "none" if criterion.sense < 0 else "never" if criterion.unit == "s" else "∞"
    text = criterion.form.format(value)
    return html.number(float(text)) if "e" in text or abs(value) >= 1e3 else text
