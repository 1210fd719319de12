"""The numbers in the sentences of the answer, and the one sentence of the front page."""

from __future__ import annotations

from pathlib import Path

from bench.findings.claims import Results, judge
from bench.findings.claims.adequacy import CALL_PRICE
from bench.findings.claims.later import HELD_RAD
from bench.findings.selection.criteria import BY_NAME
from bench.findings.selection.measured import Measured, measured
from bench.findings.selection.needs import ANSWER, EVERYWHERE, TRIED, UNHELD, Decision, decisions, has_all
from report.figures.answer import answer_tables
from report.figures.kit import families, html

NONE = "no law of this run"


def facts(folder: Path) -> dict:
    """Of the page that answers."""
    found, every = measured(folder), decisions(folder)
    able = [law for law in found.laws if law not in families.CONTROLS]
    whole = [law for law in able if EVERYWHERE.has(found, law)]
    forgetful = [law for law in able if not found.number("memory", law) and law in found.values["held"]]
    verdict = judge("C27", Results(folder))
    return {
        "lead": lead(found, every),
        "laws": len(able),
        "tried": sum(TRIED.has(found, law) for law in able),
        "whole": len(whole),
        "unheld": sum(UNHELD.has(found, law) for law in whole),
        "uniform": len(found.values["time"][found.laws[0]]),
        "directed": len(found.tables.directed) // len(found.laws),
        "noise": f"{HELD_RAD:g}",
        "price": CALL_PRICE,
        "band": f"{100 * float(found.tables.uniform['tolerance'].iloc[0]):g}",
        "rate": f"{1 / float(found.tables.uniform['dt_s'].iloc[0]):g}",
        "forgetful": len(forgetful),
        "forgetful_both": sum(has_all(found, law, (EVERYWHERE, UNHELD)) for law in forgetful) or "none",
        "verdict": str(verdict.word),
        "nearly": verdict.evidence.numbers["nearly"],
        "adequate": verdict.evidence.numbers["adequate"],
        "answers": verdict.evidence.numbers["answers"],
    }


def named(one: Decision) -> str:
    """The law of a decision, as a word."""
    return families.word(one.law) if one.law else NONE


def lead(found: Measured, every: tuple[Decision, ...]) -> html.Markdown:
    """The whole answer in a few sentences."""
    answer = next(one for one in every if one.need is ANSWER)
    if answer.law is None:
        return html.Markdown(
            f"No law of this run both settles from every start and is held at a half turn by no noise up to "
            f"{HELD_RAD:g} rad. The cheapest that settles from every start is *{named(every[0])}*."
        )
    law = answer.law
    wins = sum(law == one.law or law in one.alike for one in every)
    beside = f" The next that does costs {answer.next_number.value:.0f}." if answer.next_number else ""
    return html.Markdown(
        f"Unless a row below says otherwise: *{families.word(law)}*. It settles from every start tried, no noise up to "
        f"{HELD_RAD:g} rad holds it at a half turn, and at {found.number('cost', law):.0f} operations a tick it is the "
        f"cheapest law of which both are true.{beside} In {wins} of {len(every)} needs below it is the best or among "
        "equals."
    )


def front_page(folder: Path) -> str:
    """The answer in one sentence."""
    found, every = measured(folder), decisions(folder)
    law = next(one.law for one in every if one.need is ANSWER)
    if law is None:
        return f"No law of this run settles from every start tried and is held by no noise up to {HELD_RAD:g} rad."
    times = answer_tables.told(BY_NAME["time"], found.estimate("time", law))
    return (
        f"Of {sum(one not in families.CONTROLS for one in found.laws)} laws {families.word(law)} is the cheapest that "
        f"settles from every start tried and that no noise up to {HELD_RAD:g} rad holds at a half turn: "
        f"{found.number('cost', law):.0f} operations a tick, and 99 % of all starts settled in {times}."
    )
