"""Ask a function, find its convention, and let every fault look at the answers."""

from __future__ import annotations

import functools
import warnings
from collections.abc import Callable

import numpy as np

from bench.audit import convention, pairs
from bench.audit.asked import NO_THREE_NUMBERS, Answers, ask, inputs
from bench.audit.convention import Convention
from bench.audit.euler import Angles, find_angles
from bench.audit.fault import Evidence, Finding
from bench.audit.faults import every_fault
from bench.audit.forms import FORMS
from bench.audit.pairs import CLOSE, FINE, NEAR_IDENTITY, WIDE, Pairs
from bench.audit.report import Report
from bench.audit.stated import TAKES, Stated
from bench.errors import BadFunction


class Examined:
    """A function with its answers to every pair.

    Attributes:
        e: its answers (n x 3); raised: reasons where it had none; changed: where it wrote into its inputs.
        convention: what it means; None if nothing explains its answers.
        direction: where they should point (n x 3), zero without a convention.
        truth: what they should be (n x 3), NaN without a form.
    """

    def __init__(self, function: Callable, stated: Stated, takes: str, found: Convention | None):
        self.function, self.stated, self.takes, self.convention = function, stated, takes, found
        self.pairs = pairs.every_pair()
        self.e, self.raised, self.changed = ask(function, takes, self.pairs)
        self.size = np.linalg.norm(self.e, axis=1)
        self.direction, self.truth = self.known(self.pairs)

    @property
    def slope(self) -> float:
        """|e|/theta at the goal; 1 where it has none, as in a dead band."""
        return (self.convention and self.convention.slope) or 1.0

    def known(self, of: Pairs) -> tuple[np.ndarray, np.ndarray]:
        """direction and truth of some pairs."""
        if not self.convention:
            return np.zeros((len(of.angle), 3)), np.full((len(of.angle), 3), np.nan)
        sign = 1.0 if self.convention.sign == "to-goal" else -1.0
        along = sign * convention.directions(of, self.convention.frame)
        if not self.convention.form:
            return along, np.full_like(along, np.nan)
        return along, self.slope * FORMS[self.convention.form].size(of.angle)[:, None] * along

    def at(self, *places: str) -> np.ndarray:
        """The pairs of these places, as a mask."""
        return np.isin(self.pairs.place, places)

    def ask(self, of: Pairs) -> Answers:
        """Answers to other pairs."""
        return ask(self.function, self.takes, of)

    def evidence(self, i: int, right: bool = True) -> Evidence:
        """The pair of this number."""
        one = self.pairs.chosen(slice(i, i + 1))
        (now,), (goal,) = inputs(self.takes, one)
        truth = self.truth[i] if right and np.isfinite(self.truth[i]).all() else ""
        return Evidence(now, goal, self.raised[i] or self.e[i], truth)

    @functools.cached_property
    def error(self) -> np.ndarray:
        """|e - truth| (n), of either direction where 180° is nearer than can be told; NaN without a form."""
        straight = np.linalg.norm(self.e - self.truth, axis=1)
        either = self.pairs.distance < UNDECIDED_RAD
        return np.where(either, np.minimum(straight, np.linalg.norm(self.e + self.truth, axis=1)), straight)

    @functools.cached_property
    def euler(self) -> Angles | None:
        """The Euler angles that e is, if it is any."""
        return find_angles(self)

    @functools.cached_property
    def apart(self) -> np.ndarray:
        """Angle (n) between answers and where they should point [rad]."""
        angle = convention.apart(self.e, self.direction)
        return np.where(self.pairs.distance < UNDECIDED_RAD, np.minimum(angle, np.pi - angle), angle)


UNDECIDED_RAD = 1e-7
"""Nearer to 180° than this, the long way is longer than the short one by less than a count of an encoder."""


def examine(function: Callable, stated: Stated, name: str) -> Report:
    """The report on a function; if it has no convention, of that input for which the mistake is known, if it is."""
    stated.check([one.name for one in every_fault()])
    reports = []
    with warnings.catch_warnings(), np.errstate(all="ignore"):  # answers may be infinite, or no numbers
        warnings.simplefilter("ignore", RuntimeWarning)
        for takes, found in understood(function, stated, name):
            examined = Examined(function, stated, takes, found)
            reports.append(Report(name, len(examined.e), takes, found, findings(examined)))
    return min(reports, key=lambda one: UNKNOWN in one.faults)


UNKNOWN = "misaligned"


def findings(examined: Examined) -> tuple[Finding, ...]:
    """What is wrong with it, faults first, without what others explain."""
    found = [(one, one.find(examined)) for one in every_fault()]
    names = {one.name for one, what in found if what}
    kept = [
        Finding(one, what, one.name in examined.stated.accept)
        for one, what in found
        if what and not names & set(one.unless)
    ]
    return tuple(sorted(kept, key=lambda one: not one.is_fault))


def understood(function: Callable, stated: Stated, name: str) -> list[tuple[str, Convention | None]]:
    """What it takes and its convention; if nothing explains its answers, all that it may take.

    Errors:
        BadFunction: of nothing that it may take does it return three numbers.
    """
    every = pairs.every_pair()
    some = every.chosen(np.isin(every.place, (WIDE, CLOSE, FINE, NEAR_IDENTITY)))
    known: list[tuple[float, str, Convention]] = []
    answered: list[tuple[str, Convention | None]] = []
    reasons = {}
    for takes in possible(stated):
        first = ask(function, takes, some.chosen(slice(0, None, 90)))
        if sum(map(bool, first.raised)) > len(first.raised) / 2:
            reasons[takes] = next(filter(None, first.raised))
            continue
        answered.append((takes, None))
        share, found = convention.find(takes, some, ask(function, takes, some).e)
        if found:
            known.append((share, takes, found))
    if not answered:
        said = "; ".join(f"given {one}: {reason.removeprefix(NO_THREE_NUMBERS)}" for one, reason in reasons.items())
        raise BadFunction(
            f"{name} returns three numbers neither of two 3 x 3 matrices nor of two quaternions ({said}); wrap it in "
            f"a function of (R, R_d) or (q, q_d) that returns its three numbers"
        )
    return [max(known, key=lambda one: one[0])[1:]] if known else answered


def possible(stated: Stated) -> tuple[str, ...]:
    """What may be tried: of quaternions both orders, for the wrong one is a fault that is looked for."""
    if stated.takes is None:
        return TAKES
    others = () if stated.takes == "matrix" else TAKES[1:]
    return tuple(dict.fromkeys((stated.takes, *others)))
