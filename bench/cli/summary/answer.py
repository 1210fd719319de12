"""Which law to use, and the situations in which another is better, as a run's numbers decide."""

from __future__ import annotations

from bench.cli.paragraphs import Paragraph, listed
from bench.cli.screen import counted
from bench.findings.claims.adequacy import HELD_RAD
from bench.findings.selection import gains, needs
from bench.findings.selection.criteria import BY_NAME
from bench.findings.selection.measured import Measured
from bench.findings.selection.needs import Advice, Decision, advise
from bench.findings.selection.words import NAMED, cost, number, standing, together

NOISE = f"worst-case attitude noise up to {HELD_RAD:g} rad"


def paragraphs(found: Measured) -> list[Paragraph]:
    """Return the law to use, and the exceptions where there are laws to choose from."""
    advice = advise(found)
    said = [Paragraph("Which law", (_default(advice, found),))]
    said += _ours(found) if advice.default.law else []
    every = tuple(_exception(one, advice.default.law, found) for one in advice.exceptions if one.law)
    return [*said, Paragraph("Exceptions", every)] if every and len(found.laws) > 1 else said


def _default(advice: Advice, found: Measured) -> str:
    one = advice.default
    starts = (len(found.tables.uniform) + len(found.tables.directed)) // len(found.laws)
    everywhere = f"settles from all {starts:,} starts tried without unwinding"
    if one.law is None:
        return _nothing(found, everywhere)
    alone = standing(one, str) if len(found.laws) > 1 else "This run has no other law to compare it with."
    return (
        f"Use the law {one.law} (published: {found.tables.contenders[one.law].regulator.source}) at "
        f"{gains.gains_in_words(found)}, in simulation. It {everywhere}, 99 % of the uniform ones within "
        f"{number('time', found.number('time', one.law))}, and no {NOISE} can trap it at a 180° rotation. {alone} It "
        f"takes {cost(found, one.law)}."
    )


def _ours(found: Measured) -> list[Paragraph]:
    """Compare our own law with the advised one at each damping ratio, and say what other rules advise."""
    own = gains.ours(found)
    if own is None:
        return []
    others = [
        f"If {words}: {law}{f' (a tie of {len(tied) + 1})' if tied else ''}."
        for words, law, tied in gains.by_other_rules(found)
        if law
    ]
    compared = f"{gains.ours_in_words(own)} {gains.compare_at_all_gains()}"
    return [Paragraph("Ours", (compared,)), Paragraph("Other rules", tuple(others))]


def _nothing(found: Measured, everywhere: str) -> str:
    """Return the answer of a run in which no law meets all requirements of the default."""
    simplest = next((law for law in found.laws if needs.EVERYWHERE.has(found, law)), None)
    laws = listed(found.laws) if len(found.laws) <= NAMED else counted(len(found.laws), "law")
    if simplest is None:
        return f"No law of this run ({laws}) {everywhere}."
    why = f"{NOISE} holds each such law at some 180° rotation"
    if not needs.TRIED.has(found, simplest):
        why = "it was not tried under perturbations"
    elif not found.values["held"]:
        why = "whether noise traps it at a 180° rotation was not tried (perturbation half-turn-noise)"
    return f"Of this run ({laws}) {simplest} is the simplest law that {everywhere}; {why}."


def _exception(one: Decision, usual: str | None, found: Measured) -> str:
    """Say which law a situation leads to, its numbers and the default's, and with what it ties.

    A criterion is named where there are several.
    """

    def has(law: str) -> str:
        several = len(one.need.by) > 1 and law == one.law
        names = [f"{BY_NAME[by].title.lower()} " if several else "" for by in one.need.by]
        return ", ".join(name + number(by, found.number(by, law)) for name, by in zip(names, one.need.by, strict=True))

    law = one.law or ""
    beside = f"; {usual} {has(usual)}" if usual in one.asked else ""
    numbers = f" ({has(law)}{beside})" if one.need.by else ""
    tied = f", tied with {together(one.tied)}" if one.tied else ""
    words = one.need.words
    return f"{words[0].upper()}{words[1:]}: {law}{numbers}{tied}."
