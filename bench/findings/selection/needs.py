"""All criteria of all laws, with intervals, what a robot asks of a law, and the rule by which one is advised.

The rule was written and committed before any run was judged by it:

1. Asked are the laws that have a robot's facts and were measured by its criteria.
2. One law is better than another by a criterion if it is so by more than the criterion's `notable` share (a hundredth),
   and the 95 % interval of the difference over the starts, which both were given, leaves out zero (paired bootstrap,
   Efron 1979). Time a tick is compared on a whole controller: better by `tick` is what is better by more than
   MEASURABLE of its tick. All else is a tie. A law that was not timed ties by `tick` with all.
3. A law dominates another if it is better by some criterion and worse by none. A front is what no law dominates
   (Pareto 1906).
4. The best are the front by the robot's own criteria; kept of these is the front by GENERAL.
5. If several are kept they tie, and the simplest of them is advised: of least memory, then of fewest operations, each
   addition, product, quotient, root or call counted once.

Where a robot takes torques and a model cancels the inertia, the map of situations advises (`regions`).
"""

import functools
import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from bench.experiments.tables.statistics import TAIL, quantile, resampled
from bench.findings.claims.adequacy import DETOUR, HELD_RAD, SETTLED_SHARE
from bench.findings.claims.tables import Results
from bench.findings.selection.criteria import BY_NAME, CRITERIA, Criterion
from bench.findings.selection.tables import Tables, tables_of

LARGEST, EXCEEDING = 1.0, 5
"""Level of a maximum; and how many starts of one law must exceed all of another's: of equal laws as many do by chance
in 2^-5, 3 %, of cases."""


class Measured(NamedTuple):
    """values: criterion -> law -> one value a start, or one alone."""

    tables: Tables
    values: dict[str, dict[str, np.ndarray]]

    @property
    def laws(self) -> list[str]:
        """All laws, the simplest first."""
        return list(self.tables.contenders)

    def number(self, criterion: str, law: str) -> float:
        """Return a criterion of a law; not a number if the law was not run for it."""
        values = self.values[criterion].get(law)
        return math.nan if values is None or not len(values) else float(statistic(BY_NAME[criterion])(values))

    def beats(self, criterion: str, law: str, other: str) -> bool:
        """Tell whether a law is better by a criterion, notably, and not by the chance of these starts.

        Of maxima: at least EXCEEDING of the other's starts exceed all of the law's (S. Rosenbaum, Ann. Math. Statist.
        25, 1954).
        """
        one = BY_NAME[criterion]
        own, others = (one.sense * self.number(criterion, name) for name in (law, other))
        if not own < others or (np.isfinite(others) and others - own <= max(one.least, one.notable * abs(others))):
            return False
        values, beside = self.values[criterion][law], self.values[criterion][other]
        if len(values) < 2 or len(values) != len(beside):
            return True
        if one.level == LARGEST:
            return bool((one.sense * beside > (one.sense * values).max()).sum() >= EXCEEDING)
        with np.errstate(invalid="ignore"):
            less = one.sense * (_drawn(criterion, values.tobytes()) - _drawn(criterion, beside.tobytes()))
        # where neither settles there is no difference
        return bool(quantile(np.nan_to_num(less, nan=0.0, posinf=math.inf, neginf=-math.inf), 1.0 - TAIL) < 0.0)


@functools.lru_cache(maxsize=1024)
def _drawn(criterion: str, values: bytes) -> np.ndarray:
    """Return a law's number by each resample of the starts; drawn once, for it is held against many laws'."""
    return resampled(np.frombuffer(values), statistic(BY_NAME[criterion]))


def statistic(one: Criterion) -> Any:
    """Return what is made of a law's values: statistic(values, axis=-1) -> numbers."""
    level = one.level
    return np.mean if isinstance(level, str) else lambda values, axis=-1: quantile(values, level, axis)


def measure(results: Results) -> Measured:
    """Measure all criteria of a run."""
    tables = tables_of(results)
    return Measured(tables, {one.name: one.measure(tables) for one in CRITERIA})


@functools.cache
def measured(folder: Path, measure: Callable[[Results], Measured] = measure) -> Measured:
    """Measure all criteria of the run in a folder."""
    return measure(Results(folder))


GENERAL = ("time", "worst", "effort", "peak", "variation", "tick")
"""What counts in every situation: how long it takes, what it asks of motors, and of the computer."""


def front(found: Measured, laws: Sequence[str], criteria: Sequence[str]) -> list[str]:
    """Return the laws that no other dominates, in the order given; of a circle all, for ties are not transitive."""
    kept = [law for law in laws if not any(dominates(found, other, law, criteria) for other in laws if other != law)]
    return kept or list(laws)


def dominates(found: Measured, law: str, other: str, criteria: Sequence[str]) -> bool:
    """Tell whether a law is better than another by some criterion, and worse by none."""
    is_better = any(found.beats(one, law, other) for one in criteria)
    return is_better and not any(found.beats(one, other, law) for one in criteria)


CHATTER = 1.0
"""Largest change of the command from tick to tick at rest [rad/s^2]: a hundredth of Kp times a radian. A linear loop
that has just come to rest from 180 degrees changes by (Kp w + Kv (Kp b + Kv w)) dt = 0.25 at most, b = 0.063 rad being
the band and w = b/0.25 s."""

Fact = Callable[[Measured, str], bool]


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
