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


Fact = Callable[[Measured, str], bool]
"""A test whether a law meets a requirement."""


class Need(NamedTuple):
    """What a robot asks of a law: facts, and the criteria that decide; none: what counts everywhere."""

    facts: tuple[Fact, ...]
    by: tuple[str, ...] = ()


class Decision(NamedTuple):
    """What the rule makes of a need.

    law: the one that is advised, None if none has the facts. tied: the others that are kept, the simplest first.
    best: what no law dominates by the need's own criteria, `law` and `tied` among them. asked: all that have the
    facts and were measured.
    """

    law: str | None
    tied: tuple[str, ...]
    best: tuple[str, ...]
    asked: tuple[str, ...]


def settles_everywhere(found: Measured, law: str) -> bool:
    """Tell whether a law settles from every start of the run, without unwinding."""
    return not found.number("lost", law) and not found.number("unsettled", law) and found.number("detour", law) < DETOUR


def is_unheld(found: Measured, law: str) -> bool:
    """Tell whether no worst-case noise up to HELD_RAD can trap a law at a 180° rotation."""
    return found.number("held", law) > HELD_RAD


FACTS: dict[str, Fact] = {
    "tried": lambda found, law: law in found.values["variation"],  # it was perturbed in this run
    "everywhere": settles_everywhere,
    "nearly": lambda found, law: found.number("unsettled", law) <= 100.0 * (1.0 - SETTLED_SHARE) + 1e-9,
}
"""The facts by their words in robots.toml."""


def decide(need: Need, found: Measured) -> Decision:
    """Apply the rule to a need; a law of ours is never advised."""
    asked = tuple(
        law
        for law in found.laws
        if not found.tables.contenders[law].regulator.is_ours()
        and all(has(found, law) for has in need.facts)
        and all(len(found.values[one].get(law, ())) for one in need.by)
    )
    if not asked:
        return Decision(None, (), (), ())
    best = front(found, asked, need.by)
    kept = front(found, best, GENERAL)
    law = min(kept, key=lambda one: (*found.tables.simplicity(one), one))  # the simplest; of two alike, by name
    return Decision(law, tuple(one for one in kept if one != law), tuple(best), asked)
