"""A function with its answers to every pair."""

from __future__ import annotations

import functools
from collections.abc import Callable

import numpy as np

from bench.audit import convention, pairs
from bench.audit.asked import Answers, ask, inputs
from bench.audit.convention import Convention
from bench.audit.fault import Evidence
from bench.audit.forms import FORMS
from bench.audit.pairs import Pairs
from bench.audit.stated import Stated

UNDECIDED_RAD = 1e-7
"""Nearer to 180° than this, the long way is longer than the short one by less than a count of an encoder."""


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
        """|e - truth| (n), of the nearer direction where 180° is too close to tell; NaN without a form."""
        straight = np.linalg.norm(self.e - self.truth, axis=1)
        either = self.pairs.distance < UNDECIDED_RAD
        return np.where(either, np.minimum(straight, np.linalg.norm(self.e + self.truth, axis=1)), straight)

    @functools.cached_property
    def apart(self) -> np.ndarray:
        """Angle (n) between answers and where they should point [rad]."""
        angle = convention.apart(self.e, self.direction)
        return np.where(self.pairs.distance < UNDECIDED_RAD, np.minimum(angle, np.pi - angle), angle)
