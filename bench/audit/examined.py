"""A function with its answers to every pair, and models of answers of a function that mixes something up."""

import functools
import warnings
from collections.abc import Callable, Iterable
from typing import NamedTuple

import numpy as np

from bench.audit import convention, pairs
from bench.audit.convention import FORMS, Convention, Stated
from bench.audit.pairs import Pairs, Place

NO_THREE_NUMBERS = "it returned no three numbers, but "


ENDS, HANGS, INTERFACE = "ends-process", "hangs", "c-interface"
"""Names of the faults that end the asking, each a file of faults/ without a `find`."""


class Lost(BaseException):
    """A call did not return, for a `fault` of those above; `how`: as in "SIGSEGV". No `except Exception` stops it."""

    def __init__(self, fault: str, how: str, now: np.ndarray, goal: np.ndarray):
        super().__init__(how)
        self.fault, self.how, self.now, self.goal = fault, how, now, goal


FAULT, NOTE = "fault", "note"


class PairEvidence(NamedTuple):
    """A pair to reproduce: what the function is given, what it said, and what would be right, if that is known."""

    now: np.ndarray
    goal: np.ndarray
    said: np.ndarray | str
    right: np.ndarray | str = ""


class Symptom(NamedTuple):
    """What `find` returns: how it shows, in numbers; a pair; and whether it is a property that one may want.

    effect, cure: of this function, where the fault's own words are too general.
    """

    text: str
    evidence: PairEvidence | None = None
    severity: str = FAULT
    effect: str = ""
    cure: str = ""


class Answers(NamedTuple):
    """Answers e (n x 3), NaN where there is none; raised (n): the reason there; changed (n): inputs written into."""

    e: np.ndarray
    raised: list[str]
    changed: np.ndarray


def inputs(takes: str, pairs: Pairs) -> tuple[np.ndarray, np.ndarray]:
    """Return what the function is given, pair by pair."""
    if takes == "matrix":
        return pairs.R, pairs.R_d
    order = [0, 1, 2, 3] if takes == "wxyz" else [1, 2, 3, 0]
    return pairs.q[:, order], pairs.q_d[:, order]


def evaluate(function: Callable, now: np.ndarray, goal: np.ndarray) -> Answers:
    """Return its answers to every pair of two arrays, each from arrays of its own."""
    e, raised, changed = np.full((len(now), 3), np.nan), [], np.zeros(len(now), bool)
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        for i, (one, other) in enumerate(zip(now, goal, strict=True)):
            given = one.copy(), other.copy()
            e[i], reason = _answer(function, *given)
            raised.append(reason)
            changed[i] = not (np.array_equal(given[0], one) and np.array_equal(given[1], other))
    return Answers(e, raised, changed)


def _answer(
    function: Callable, now: np.ndarray, goal: np.ndarray
) -> tuple[np.ndarray | float, str]:
    """Three numbers, or NaN and the reason."""
    try:
        said = function(now, goal)
    except (KeyboardInterrupt, Lost):
        raise
    except SystemExit as error:
        raise Lost(ENDS, f"it exits (SystemExit: {error})", now, goal) from error
    except (
        BaseException
    ) as error:  # whatever else it raises is its answer; panics of Rust are no Exception
        return np.nan, f"{type(error).__name__}: {error}"
    try:
        numbers = np.asarray(said).astype(float)
    except (TypeError, ValueError):
        return np.nan, f"{NO_THREE_NUMBERS}{type(said).__name__}"
    except RuntimeError as error:  # a tensor that keeps a gradient
        return np.nan, f"{NO_THREE_NUMBERS}{type(said).__name__} ({error})"
    if numbers.size != 3:
        return np.nan, f"{NO_THREE_NUMBERS}an array of shape {numbers.shape}"
    return numbers.reshape(3), ""


Fresh = Callable[[], Callable]
COUNT_RAD = 2.0 * np.pi / 2**24
"""An error below this is none to a robot: one count of an encoder of 24 bits, 3.7e-7 rad."""
UNDECIDED_RAD = COUNT_RAD / 2.0
"""Nearer to 180° than this, the long way is longer than the short one by less than a count."""


class Examined:
    """A function with its answers to every pair.

    Attributes:
        e: its answers (n x 3); raised: reasons where it had none; changed: where it wrote into its inputs.
        convention: what it means; None if nothing explains its answers.
        fresh: loads the function once more, with none of what it has kept; None where that cannot be done.
        direction: where they should point (n x 3), zero without a convention.
        truth: what they should be (n x 3), NaN without a form.
    """

    def __init__(
        self,
        function: Callable,
        stated: Stated,
        takes: str,
        found: Convention | None,
        fresh: Fresh | None = None,
    ):
        self.function, self.stated, self.takes, self.convention, self.fresh = (
            function,
            stated,
            takes,
            found,
            fresh,
        )
        self.pairs = pairs.every_pair()
        self.e, self.raised, self.changed = self.evaluate(self.pairs)
        self.size = np.linalg.norm(self.e, axis=1)
        self.direction, self.truth = self.known(self.pairs)

    @property
    def form(self) -> str:
        """Return the word of its form; empty where it has a size of its own, or no convention."""
        return self.convention.form if self.convention else ""

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

    def at(self, *places: Place) -> np.ndarray:
        """Return the pairs of these places, as a mask."""
        return self.pairs.at(*places)

    def evaluate(self, of: Pairs) -> Answers:
        """Return its answers to other pairs."""
        return evaluate(self.function, *inputs(self.takes, of))

    def evidence(self, i: int, right: bool = True) -> PairEvidence:
        """Return the pair of this number."""
        one = self.pairs.chosen(slice(i, i + 1))
        (now,), (goal,) = inputs(self.takes, one)
        truth = self.truth[i] if right and np.isfinite(self.truth[i]).all() else ""
        return PairEvidence(now, goal, self.raised[i] or self.e[i], truth)

    def first(
        self, which: np.ndarray, text: str, right: bool = True, severity: str = FAULT
    ) -> Symptom | None:
        """Return what is found at the first pair of a mask; None if the mask is empty."""
        return (
            Symptom(text, self.evidence(int(np.argmax(which)), right), severity)
            if which.any()
            else None
        )

    @functools.cached_property
    def error(self) -> np.ndarray:
        """|e - truth| (n), of the nearer direction where 180° is too close to tell; NaN without a form."""
        straight = np.linalg.norm(self.e - self.truth, axis=1)
        either = self.pairs.distance < UNDECIDED_RAD
        return np.where(
            either, np.minimum(straight, np.linalg.norm(self.e + self.truth, axis=1)), straight
        )

    @functools.cached_property
    def apart(self) -> np.ndarray:
        """Angle (n) between answers and where they should point [rad]."""
        angle = convention.apart(self.e, self.direction)
        return np.where(
            self.pairs.distance < UNDECIDED_RAD, np.minimum(angle, np.pi - angle), angle
        )

    @functools.cached_property
    def noise(self) -> float:
        """What rounding leaves across the axis, of the size, where nothing is difficult; NaN without a convention."""
        return float(np.nanmedian(np.sin(self.apart[self.at("wide")])))


Model = tuple[str, np.ndarray]
"""Words, and vectors (n x 3)."""

EXPLAINED_RAD = 1e-3
"""Largest angle to a model's line; of two random directions one in two million is so near."""


def explanation(
    examined: Examined, models: Callable[[Pairs], Iterable[Model]], text: str, right: bool = False
) -> Symptom | None:
    """Return the model along whose vectors most answers lie, with a pair that shows it; None if there is none.

    models: pairs -> (words, vectors n x 3) of each. text: what is said, with {} for a model's words.
    """
    if examined.convention:
        return None
    here = np.flatnonzero(examined.at("wide"))
    best, share = None, convention.ENOUGH
    for words, vectors in models(examined.pairs.chosen(here)):
        angle = convention.apart(examined.e[here], vectors)
        is_along = (angle < EXPLAINED_RAD) | (angle > np.pi - EXPLAINED_RAD)
        if is_along.mean() > share:
            evidence = examined.evidence(int(here[np.argmax(is_along)]), right)
            best, share = Symptom(text.format(words), evidence), float(is_along.mean())
    return best
