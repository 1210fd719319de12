"""Situations as data, and the law that the rule (`rule`) advises in each, by the numbers of a run.

What any page, card or command says of which law to use comes of `advice`, and what it calls the best by a criterion of
`best_by`.
"""

from __future__ import annotations

import functools
import tomllib
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

from bench.findings.claims.adequacy import DETOUR, HELD_RAD, SETTLED_SHARE
from bench.findings.claims.tables import Results
from bench.findings.selection import criteria
from bench.findings.selection.measured import GENERAL, Measured, front, measure, measured, simplest

CONTINUOUS = 1e-3
"""Jump of the command over kp [rad] below which it is the slope's: f'(pi) 2e-6 of any law here."""

CHATTER = 1.0
"""Largest change of the command from tick to tick at rest [rad/s^2]: a hundredth of Kp times a radian. A linear loop
that has just come to rest from 180 degrees changes by (Kp w + Kv (Kp b + Kv w)) dt = 0.25 at most, b = 0.063 rad being
the band and w = b/0.25 s."""


class Fact(NamedTuple):
    """Hold a requirement in words, and the test whether a law meets it."""

    words: str
    has: Callable[[Measured, str], bool]


class Need(NamedTuple):
    """A situation: the facts it asks of a law, and the criteria it decides by; none: by what counts everywhere.

    is_apart: another robot, whose law is always given, also where the default's ties with it.
    """

    words: str
    facts: tuple[Fact, ...]
    by: tuple[str, ...] = ()
    is_apart: bool = False


class Decision(NamedTuple):
    """What the rule makes of a situation.

    law: the one that is advised, None if none has the facts. tied: the others that are kept, the simplest first.
    best: what no law dominates by the situation's own criteria, `law` and `tied` among them. asked: all that have the
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
QUIET = Fact("its command is quiet at rest", lambda found, law: found.number("chatter", law) <= CHATTER)
UNHELD = Fact(
    f"no worst-case noise up to {HELD_RAD:g} rad can trap it at a 180° rotation",
    lambda found, law: found.number("held", law) > HELD_RAD,
)
FORGETFUL = Fact("keeps nothing from tick to tick", lambda found, law: not found.number("memory", law))
SMOOTH = Fact("its command does not jump at 180°", lambda found, law: abs(found.number("jump", law)) < CONTINUOUS)
NEARLY = Fact(
    f"settles from {SETTLED_SHARE:.1%} of evenly spread starts",
    lambda found, law: found.number("unsettled", law) <= 100.0 * (1.0 - SETTLED_SHARE) + 1e-9,
)
TRIED = Fact("was perturbed in this run", lambda found, law: law in found.values["variation"])

MATTERS = 0.1
"""Share by which another law must be better by a situation's criterion before the situation is named: for less nobody
changes a controller."""

SURE = (TRIED, EVERYWHERE, QUIET)
FACTS = {
    **{"tried": TRIED, "everywhere": EVERYWHERE, "quiet": QUIET, "unheld": UNHELD},
    **{"forgetful": FORGETFUL, "smooth": SMOOTH, "nearly": NEARLY},
}
"""The facts by their words in situations.toml."""

SITUATIONS = tomllib.loads(Path(__file__).with_name("situations.toml").read_text(encoding="utf-8"))


def read_needs(command: str) -> dict[str, Need]:
    """Return the situations of robots that take a command, by name, the usual one first; SURE if no facts are named."""
    found = {}
    for name, one in SITUATIONS["needs"][command].items():
        facts = tuple(FACTS[word] for word in one["facts"]) if "facts" in one else SURE
        words = one["words"].format(**vars(criteria))
        found[name] = Need(words, facts, tuple(one.get("by", ())), one.get("is_apart", False))
    return found


OF_TORQUES = read_needs("torques")
DEFAULT, *_others = OF_TORQUES.values()
NEEDS = tuple(_others)
ARM, FORGETS = OF_TORQUES["arm"], OF_TORQUES["forgets"]


class Advice(NamedTuple):
    """What is advised in every situation.

    default: where nothing else is known. exceptions: the situations in which another law is better than its law, or it
    lacks a fact. others: those that decide nothing, for no law is better there.
    """

    default: Decision
    exceptions: tuple[Decision, ...]
    others: tuple[Decision, ...]

    @property
    def every(self) -> list[Decision]:
        """All situations, the default first."""
        return [self.default, *self.exceptions, *self.others]

    def of(self, need: Need) -> Decision:
        """Return the advice in a situation; where it decides nothing, the default's law, which ties with its best."""
        one = next(each for each in self.every if each.need is need)
        law = self.default.law
        return (
            one._replace(law=law, tied=tuple(each for each in one.best if each != law)) if one in self.others else one
        )

    def uses(self, law: str) -> tuple[list[Need], list[Need]]:
        """Return the situations in which a law is advised, and those in which it ties with what is advised."""
        every = [self.default, *self.exceptions]
        return [one.need for one in every if one.law == law], [one.need for one in every if law in one.tied]


def has_all(found: Measured, law: str, facts: tuple[Fact, ...]) -> bool:
    """Whether a law has every one of the facts."""
    return all(fact.has(found, law) for fact in facts)


def is_ours(found: Measured, law: str) -> bool:
    """Whether a law was made here: it is compared with what is advised, and is not advised."""
    return found.tables.contenders[law].regulator.is_ours()


def matters(found: Measured, one: Decision, usual: str | None) -> bool:
    """Whether a situation's law is better than the usual one by more than MATTERS, or the usual one lacks a fact."""
    if one.law is None or usual not in one.asked:
        return True
    pairs = [(found.number(by, one.law), found.number(by, usual)) for by in one.need.by]
    return any(abs(own - other) > MATTERS * abs(other) for own, other in pairs)


def decide(need: Need, found: Measured, general: Sequence[str] = GENERAL) -> Decision:
    """Apply the rule to a situation on its own, without the default's law; a law of ours is never advised."""
    asked = tuple(
        law
        for law in found.laws
        if not is_ours(found, law)
        and has_all(found, law, need.facts)
        and all(len(found.values[one].get(law, ())) for one in need.by)
    )
    if not asked:
        return Decision(need, None, (), (), ())
    best = front(found, asked, need.by)
    kept = front(found, best, general)
    law = simplest(found, kept)
    return Decision(need, law, tuple(one for one in kept if one != law), tuple(best), asked)


def advise(found: Measured, usual: Need = DEFAULT, needs: Sequence[Need] = NEEDS) -> Advice:
    """All situations, decided.

    Args:
        usual: the default requirements.
    """
    default, every = decide(usual, found), [decide(need, found) for need in needs]
    is_decisive = [
        one.need.is_apart or (default.law not in one.best and matters(found, one, default.law)) for one in every
    ]
    return Advice(
        default,
        tuple(one for one, is_other in zip(every, is_decisive, strict=True) if is_other),
        tuple(one for one, is_other in zip(every, is_decisive, strict=True) if not is_other),
    )


@functools.cache
def advice(
    folder: Path,
    measure: Callable[[Results], Measured] = measure,
    usual: Need = DEFAULT,
    needs: tuple[Need, ...] = NEEDS,
) -> Advice:
    """Return what is advised by the run in a folder; by default where torques are taken and the inertia cancelled."""
    return advise(measured(folder, measure), usual, needs)


def best_by(found: Measured, criterion: str, laws: Sequence[str]) -> tuple[str, ...]:
    """Return the laws that were measured by a criterion and that no other is better than: several tie."""
    asked = [law for law in laws if len(found.values[criterion].get(law, ()))]
    return tuple(front(found, asked, (criterion,)))
