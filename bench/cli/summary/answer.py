"""Which law to use, and the three needs for which another may be better, as a run's numbers decide."""

from __future__ import annotations

import math

from bench.cli.paragraphs import Paragraph, listed
from bench.cli.screen import counted
from bench.findings.claims.adequacy import CALL_PRICE
from bench.findings.claims.later import HELD_RAD
from bench.findings.selection import criteria, needs
from bench.findings.selection.measured import Measured
from bench.findings.selection.needs import ANSWER, NEEDS, Decision, Need, decide

NAMED = 3
"""Laws named beside one that is as good; others are counted."""


def need(by: str, *facts: needs.Fact) -> Need:
    """The need that ranks by a criterion and asks these facts beside the usual ones."""
    return next(one for one in NEEDS if one.by == by and one.facts == (*needs.SURE, *facts))


SETTLES = need("cost")
EXCEPTIONS = {
    f"Motors limited to {criteria.BOUND:g} rad/s²": (need("bounded"), "median settling time {}"),
    "Lowest peak command": (need("peak"), "{}"),
    "No memory between ticks": (need("cost", needs.FORGETFUL), "{}"),
}
"""What is needed: how it is decided, and the number that decides."""


def paragraphs(found: Measured) -> list[Paragraph]:
    """The answer, and its exceptions where there are laws to choose from."""
    answer = decide(ANSWER, found)
    said = [Paragraph("Which law", (_answer(answer, found),))]
    if len(found.laws) == 1 or decide(SETTLES, found).law is None:
        return said
    others = tuple(
        f"{head}: {_exception(decide(one, found), measure, answer.law, found)}."
        for head, (one, measure) in EXCEPTIONS.items()
    )
    return [*said, Paragraph("Exceptions", others)]


def _answer(one: Decision, found: Measured) -> str:
    starts = (len(found.tables.uniform) + len(found.tables.directed)) // len(found.laws)
    everywhere = f"settles from all {starts:,} starts tried without unwinding"
    held = f"worst-case attitude noise up to {HELD_RAD:g} rad"
    if one.law is None:
        return _nothing(found, everywhere, held)
    price = f"{number('cost', one.law, found)} per tick, a sine counted as {CALL_PRICE:g}"
    among = f", the cheapest of the {one.asked} such laws among {len(found.laws)}" if one.asked > 1 else ""
    next_ = f" (next: {one.next}, {number('cost', one.next, found)})" if one.next else ""
    alone = "" if len(found.laws) > 1 else " This run has no other law to compare it with."
    return (
        f"Use the law {one.law}. It {everywhere}, and no {held} holds it at a 180° rotation. It costs {price}"
        f"{among}{next_}. 99 % of the uniform starts settle within {number('time', one.law, found)}.{alone}"
    )


def _nothing(found: Measured, everywhere: str, held: str) -> str:
    """Where no law has all that the answer must have."""
    cheapest = next((law for law in found.laws if needs.EVERYWHERE.has(found, law)), None)
    laws = listed(found.laws) if len(found.laws) <= NAMED else counted(len(found.laws), "law")
    if cheapest is None:
        return f"No law of this run ({laws}) {everywhere}."
    why = f"{held} holds each such law at some 180° rotation"
    if not needs.TRIED.has(found, cheapest):
        why = "it was not tried under perturbations"
    elif not found.values["held"]:
        why = "whether noise holds it at a 180° rotation was not tried (perturbation half-turn-noise)"
    return f"Of this run ({laws}) {cheapest} is the cheapest law that {everywhere}; {why}."


def _exception(one: Decision, measure: str, usual: str | None, found: Measured) -> str:
    """The law that a need leads to, beside the usual answer."""

    def has(law: str) -> str:
        return measure.format(number(one.need.by, law, found))

    if not found.values[one.need.by]:
        return "not tried in this run"
    if one.law is None:
        return "no law of this run that settles from every start"
    if usual in (one.law, *one.alike):
        return f"none, no law is notably better than {usual} ({has(usual)})"
    beside = f"; {usual}: {has(usual)}" if usual else ""
    alike = f"; as good: {_some(one.alike)}" if one.alike else ""
    held = found.number("held", one.law)
    is_held = needs.FORGETFUL in one.need.facts and math.isfinite(held)
    but = f", but worst-case noise of {number('held', one.law, found)} holds it at a 180° rotation" if is_held else ""
    return f"{one.law} ({has(one.law)}{beside}{alike}){but}"


def _some(laws: tuple[str, ...]) -> str:
    more = len(laws) - NAMED
    return f"{', '.join(laws[:NAMED])} and {more} more" if more > 0 else listed(list(laws))


def number(name: str, law: str, found: Measured) -> str:
    """A criterion of a law with its unit, as the criterion writes it."""
    one, value = criteria.BY_NAME[name], found.number(name, law)
    if math.isnan(value):
        return "not measured"
    if math.isinf(value):
        return "never"
    unit = "operations" if one.unit == "flops" else one.unit
    return f"{one.form.format(value)} {unit}".strip()
