"""What a user may need of a law, as data, and the law that a run's numbers name for it.

A need asks some facts of a law and then ranks by one criterion. Of the laws that no other notably beats by it
(`Measured.beats`), the cheapest is named, and the others are named beside it.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from bench.findings.claims.adequacy import DETOUR, SETTLED_SHARE
from bench.findings.claims.later import HELD_RAD
from bench.findings.selection import criteria
from bench.findings.selection.measured import Measured, measured
from bench.findings.selection.measures import worst_of_uniform
from bench.tables.statistics import Estimate

CONTINUOUS = 1e-3
"""Jump of the command over kp [rad] below which it is the slope's: f'(pi) 2e-6 of any law here."""


CHATTER = 1.0
"""Largest change of the command from tick to tick at rest [rad/s^2]: a hundredth of Kp times a radian. A linear loop
that has just come to rest from 180 degrees changes by (Kp w + Kv (Kp b + Kv w)) dt = 0.25 at most, b = 0.063 rad being
the band and w = b/0.25 s."""


class Fact(NamedTuple):
    """What is asked of a law, in words, and whether a law has it."""

    words: str
    has: Callable[[Measured, str], bool]


class Need(NamedTuple):
    """What a user needs, under a head; the facts it asks; the criterion it ranks by."""

    head: str
    words: str
    facts: tuple[Fact, ...]
    by: str


class Decision(NamedTuple):
    """law: the one to use, None if none has the facts; alike: those that no law notably beats either, by cost.

    next: the best of the others, None if there is none. asked: how many laws have the facts.
    """

    need: Need
    law: str | None
    alike: tuple[str, ...]
    next: str | None
    asked: int
    number: Estimate | None
    next_number: Estimate | None


def _settles(found: Measured, law: str) -> bool:
    return not found.number("lost", law) and not found.number("unsettled", law) and found.number("detour", law) < DETOUR


EVERYWHERE = Fact("settles from every start of the run, none the long way round", _settles)
QUIET = Fact(
    "its command is quiet at rest",
    lambda found, law: worst_of_uniform("rest_change")(found.tables)[law][0] <= CHATTER,
)
UNHELD = Fact(
    f"no worst-case noise up to {HELD_RAD:g} rad holds it at a half turn",
    lambda found, law: found.number("held", law) > HELD_RAD,
)
FORGETFUL = Fact("keeps nothing from tick to tick", lambda found, law: not found.number("memory", law))
SMOOTH = Fact("its command does not jump at half turns", lambda found, law: abs(found.number("jump", law)) < CONTINUOUS)
NEARLY = Fact(
    f"settles from {SETTLED_SHARE:.1%} of evenly spread starts",
    lambda found, law: found.number("unsettled", law) <= 100.0 * (1.0 - SETTLED_SHARE) + 1e-9,
)
ON_ANGLES = Fact(
    "is computed from Z-Y-X angles",
    lambda found, law: getattr(found.tables.contenders[law].representation, "name", "") == "zyx-euler",
)
TRIED = Fact("was perturbed in this run", lambda found, law: law in found.values["variation"])

SURE = (TRIED, EVERYWHERE, QUIET)
ANYWHERE, COMMAND, PERTURBED, GIVEN = (
    "From every start",
    "The command",
    "Under perturbation",
    "With less at hand",
)

ANSWER = Need(ANYWHERE, "the same, and no noise may hold it at a half turn", (*SURE, UNHELD), "cost")
"""What C27 asks for: the cheapest law that nothing stops."""

NEEDS = (
    Need(ANYWHERE, "every start settled, at the least cost", SURE, "cost"),
    ANSWER,
    Need(ANYWHERE, "the fastest, at equal stiffness near the goal", SURE, "time"),
    Need(ANYWHERE, "the same settling time from everywhere: a linear response", SURE, "spread"),
    Need(COMMAND, "least effort", SURE, "effort"),
    Need(COMMAND, "the smoothest command", SURE, "variation"),
    Need(COMMAND, "the smallest peak", SURE, "peak"),
    Need(COMMAND, f"the fastest whose peak is {criteria.PEAK:g} rad/s²: gains to suit", SURE, "matched"),
    Need(COMMAND, f"the fastest behind motors that end at {criteria.BOUND:g} rad/s²", SURE, "bounded"),
    Need(PERTURBED, f"a computer that answers {criteria.SLOW_HZ:g} times a second", SURE, "slow"),
    Need(PERTURBED, f"{1e3 * criteria.LATE_S:g} ms of delay", SURE, "late"),
    Need(PERTURBED, f"inertia {criteria.HEAVY:g} times what the model says", SURE, "heavy"),
    Need(PERTURBED, f"a body that spins at {criteria.SPIN:g} rad/s", SURE, "spinning"),
    Need(PERTURBED, f"a goal that moves at {criteria.MOVING:g} rad/s, with feedforward", SURE, "follows"),
    Need(PERTURBED, f"orientation known to {criteria.NOISY_RAD:g} rad, and a calm command", SURE, "noisy"),
    Need(GIVEN, "no memory in the controller", (*SURE, FORGETFUL), "cost"),
    Need(GIVEN, "a command that never jumps", (TRIED, NEARLY, FORGETFUL, SMOOTH), "time"),
    Need(GIVEN, "the fewest operations, where half turns never occur", (TRIED, NEARLY), "cost"),
    Need(GIVEN, "Z-Y-X angles and no matrix", (TRIED, NEARLY, ON_ANGLES), "lost"),
    Need(GIVEN, "a robot's arm", SURE, "arms"),
)


def has_all(found: Measured, law: str, facts: tuple[Fact, ...]) -> bool:
    """Whether a law has every one of the facts."""
    return all(fact.has(found, law) for fact in facts)


def decide(need: Need, found: Measured) -> Decision:
    """The law that a need leads to."""
    able = [law for law in found.laws if has_all(found, law, need.facts)]
    asked = [law for law in able if law in found.values[need.by]]
    if not asked:
        return Decision(need, None, (), None, 0, None, None)
    sense = criteria.BY_NAME[need.by].sense
    ranked = sorted(asked, key=lambda law: sense * found.number(need.by, law))
    alike = [law for law in ranked if law == ranked[0] or not found.beats(need.by, ranked[0], law)]
    others = [law for law in ranked if law not in alike]
    first, *rest = sorted(alike, key=found.laws.index)
    next_ = others[0] if others else None
    told = found.estimate(need.by, next_) if next_ else None
    return Decision(need, first, tuple(rest), next_, len(asked), found.estimate(need.by, first), told)


@functools.cache
def decisions(folder: Path) -> tuple[Decision, ...]:
    """All needs, decided by the run in a folder."""
    return tuple(decide(need, measured(folder)) for need in NEEDS)
