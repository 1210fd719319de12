"""What a robot asks of a law as data, and the law that the rule (`measured`) advises for it by the numbers of a run.

Where a robot takes torques and a model cancels the inertia, the map (`regions`) advises instead.
"""

from collections.abc import Callable
from typing import NamedTuple

from bench.findings.claims.adequacy import DETOUR, HELD_RAD, SETTLED_SHARE
from bench.findings.selection.measured import GENERAL, Measured, front

CHATTER = 1.0
"""Largest change of the command from tick to tick at rest [rad/s^2]: a hundredth of Kp times a radian. A linear loop
that has just come to rest from 180 degrees changes by (Kp w + Kv (Kp b + Kv w)) dt = 0.25 at most, b = 0.063 rad being
the band and w = b/0.25 s."""


class Fact(NamedTuple):
    """Hold a requirement in words, and the test whether a law meets it."""

    words: str
    has: Callable[[Measured, str], bool]


class Need(NamedTuple):
    """What a robot asks of a law: facts, and the criteria that decide; none: what counts everywhere."""

    words: str
    facts: tuple[Fact, ...]
    by: tuple[str, ...] = ()


class Decision(NamedTuple):
    """What the rule makes of a need.

    law: the one that is advised, None if none has the facts. tied: the others that are kept, the simplest first.
    best: what no law dominates by the need's own criteria, `law` and `tied` among them. asked: all that have the
    facts and were measured.
    """

    need: Need
    law: str | None
    tied: tuple[str, ...]
    best: tuple[str, ...]
    asked: tuple[str, ...]


def _settles(found: Measured, law: str) -> bool:
    return not found.number("lost", law) and not found.number("unsettled", law) and found.number("detour", law) < DETOUR


EVERYWHERE = Fact("settles from every start of the run, without unwinding", _settles)
UNHELD = Fact(
    f"no worst-case noise up to {HELD_RAD:g} rad can trap it at a 180° rotation",
    lambda found, law: found.number("held", law) > HELD_RAD,
)
NEARLY = Fact(
    f"settles from {SETTLED_SHARE:.1%} of evenly spread starts",
    lambda found, law: found.number("unsettled", law) <= 100.0 * (1.0 - SETTLED_SHARE) + 1e-9,
)
TRIED = Fact("was perturbed in this run", lambda found, law: law in found.values["variation"])

FACTS = {"tried": TRIED, "everywhere": EVERYWHERE, "nearly": NEARLY}
"""The facts by their words in robots.toml."""


def has_all(found: Measured, law: str, facts: tuple[Fact, ...]) -> bool:
    """Whether a law has every one of the facts."""
    return all(fact.has(found, law) for fact in facts)


def decide(need: Need, found: Measured) -> Decision:
    """Apply the rule to a need; a law of ours is never advised."""
    asked = tuple(
        law
        for law in found.laws
        if not found.tables.contenders[law].regulator.is_ours()
        and has_all(found, law, need.facts)
        and all(len(found.values[one].get(law, ())) for one in need.by)
    )
    if not asked:
        return Decision(need, None, (), (), ())
    best = front(found, asked, need.by)
    kept = front(found, best, GENERAL)
    law = min(kept, key=lambda one: (*found.tables.simplicity(one), one))  # the simplest; of two alike, by name
    return Decision(need, law, tuple(one for one in kept if one != law), tuple(best), asked)
