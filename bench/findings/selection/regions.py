"""The law that nothing beats in a situation, by the rows of results/situations, and the regions that such laws have.

The rule was committed before the map was run; `robots` applies it to robots that the map does not cover:

1. A law must settle from every start tried, exact 180° rotations among them; it must not first turn away from the goal;
   worst-case noise of 0.1 rad must not trap it at 180°; and it must not overshoot by over OVERSHOOT more than that law
   that overshoots least, of those that meet the rest (`Rule` drops each of these).
2. One law beats another in a situation if 99 % of its starts settle in a time that is shorter by more than TIE, and the
   paired 95 % interval of the ratio of the two times, over the starts that both ran, excludes 1 (`pairs`). All else is
   a tie.
3. The simplest of the laws that nothing beats is advised: of least memory, then of fewest operations.
4. A law of ours is never advised; where it is not beaten, or beats what is advised, that is said.
5. The default is the law with the widest region: advised in most of the situations that were drawn at random.
"""

import collections
import functools
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from bench.experiments.tables.run import with_contender
from bench.experiments.tables.schema import RESULTS
from bench.experiments.tables.store import read
from bench.findings.selection.jump import jump
from bench.findings.selection.pairs import columns_of, find_slower, read_pair_columns, split
from bench.law.contender import Contender
from bench.law.contenders.registry import find_contender
from tasks.situation import COORDINATES, Situation, read_situation

STUDY = RESULTS / "situations"
"""What `python -P -m bench.studies.situations` keeps."""

NAMES = list(COORDINATES)

CONTINUOUS = 1e-3
"""Jump of the command over kp [rad] below which it is the slope's: f'(pi) 2e-6 of any law here."""

OVERSHOOT = 5.0
"""Overshoot [deg] by which a law may exceed that of the law that overshoots least in a situation. At low damping every
law overshoots, so that no fixed limit would leave one."""

TIE = 0.05
"""Times that differ by less than a twentieth are no reason to choose a law."""

NEIGHBOURS = 8
"""Nearest situations whose laws say how sure an answer between the rows is."""


class Rule(NamedTuple):
    """What a law must have, and what decides; the defaults are the rule above.

    everywhere: no start is lost, no exact 180° rotation holds it. direct: it never first turns away from the goal.
    adversary: worst-case noise does not trap it. overshoot: by how much it may exceed the least overshoot [deg].
    forgetful: it keeps nothing from tick to tick. continuous: its command does not jump at 180°; exact 180° rotations
    may hold such a law, for all that keep nothing have some. by: the column that is compared; less is better. tie: the
    relative difference up to which two laws tie. least_peak: of the laws that tie, the one of least peak command is
    advised.
    """

    everywhere: bool = True
    direct: bool = True
    adversary: bool = True
    overshoot: float = OVERSHOOT
    forgetful: bool = False
    continuous: bool = False
    by: str = "time"
    tie: float = TIE
    least_peak: bool = False


RULE = Rule()

PAIRED = ("time", "missed")
"""Numbers by which laws are compared start by start."""


class RuleVerdict(NamedTuple):
    """What the rule makes of a situation.

    Attributes:
        law: The law that is advised; None if none is left.
        tied: The others that nothing beats, the simplest first.
        ours: Our own laws that no other law beats.
        faster: Those of our own laws that beat the advised one.
        eligible: Number of laws that meet the requirements.
    """

    law: str | None
    tied: tuple[str, ...] = ()
    ours: tuple[str, ...] = ()
    faster: tuple[str, ...] = ()
    eligible: int = 0

    @property
    def unbeaten(self) -> frozenset[str]:
        """The advised law and those that tie with it."""
        return frozenset((self.law, *self.tied) if self.law else ())


class Facts(NamedTuple):
    """What a law has in every situation: numbers kept, whether its command jumps at 180°, whether it is ours."""

    memory: int
    is_continuous: bool
    is_ours: bool


FACTS = "facts"
"""The column of facts, in rows of laws that this repository may not have."""


def find_facts(one: Contender) -> Facts:
    """Return the facts of a law, which may be a user's."""
    return Facts(len(one.regulator.memory or ()), abs(jump(one)) < CONTINUOUS, one.regulator.is_ours())


@functools.cache
def facts_of(law: str) -> Facts:
    """Return the facts of a law of this repository."""
    return find_facts(find_contender(law))


def list_facts(rows: Mapping[Any, Any]) -> list[Facts]:
    """Return the facts of the law of each row."""
    if FACTS in rows:
        return list(rows[FACTS])
    return [facts_of(law) for law in np.asarray(rows["contender"], dtype=object)]


@functools.cache
def read_map(folder: Path = STUDY) -> pd.DataFrame:
    """Return the rows of a map, `with_words`."""
    return with_words(read(folder, "situations"))


def with_words(rows: pd.DataFrame) -> pd.DataFrame:
    """Return rows of situations.parquet with `contender` and `situation`, the word of each row's situation."""
    words = [Situation(*values).word for values in rows[NAMES].itertuples(index=False, name=None)]
    return with_contender(rows).assign(situation=words)


def decide(rows: pd.DataFrame, rule: Rule = RULE, pairs: pd.DataFrame | None = None) -> RuleVerdict:
    """Apply the rule to the rows of one situation, a law each; pairs: the comparisons of its laws, two by two.

    Without pairs the two intervals must not overlap instead, which leaves more ties.
    """
    return _decide(columns_of(rows), rule, pairs)


def _decide(rows: dict[str, np.ndarray], rule: Rule, pairs: Mapping[Any, Any] | None) -> RuleVerdict:
    """Do so on columns: the rules of `sensitivity` ask for ten thousand verdicts."""
    has = meets(rows, rule)
    qualified = {name: values[has] for name, values in rows.items()}
    laws = [str(law) for law in qualified["contender"]]
    facts = list_facts(qualified)
    is_ours = np.array([fact.is_ours for fact in facts], dtype=bool)
    if is_ours.all():  # or none is left
        return RuleVerdict(None, ours=tuple(laws))
    beaten = find_beaten(qualified, rule, pairs)
    is_beaten = np.any(beaten[:, ~is_ours], axis=1)
    names = np.array(laws)
    memory = np.array([fact.memory for fact in facts])
    order = [names, qualified["operations"], memory, *([qualified["peak"]] if rule.least_peak else [])]
    unbeaten = np.flatnonzero(~is_ours & ~is_beaten)
    law, *tied = names[unbeaten[np.lexsort([one[unbeaten] for one in order])]].tolist()
    beats_advised = beaten[laws.index(law)]
    ours = names[is_ours & ~is_beaten].tolist()
    faster = names[is_ours & beats_advised].tolist()
    return RuleVerdict(law, tuple(tied), tuple(ours), tuple(faster), len(laws))


def meets(rows: Mapping[Any, Any], rule: Rule = RULE) -> np.ndarray:
    """Return whether the law of each row meets the requirements of a rule in the situation of the row."""
    has = meets_but_overshoot(rows, rule)
    if math.isinf(rule.overshoot):  # it need not have been measured
        return has
    return has & ~find_overshooting(rows, has, rule.overshoot)


def find_overshooting(rows: Mapping[Any, Any], has: np.ndarray, more: float) -> np.ndarray:
    """Return which laws overshoot by over `more` degrees more than the least of the published laws that have the rest.

    Nothing overshoots where no published law has the rest: there is nothing to compare with.
    """
    is_compared = has & ~np.array([fact.is_ours for fact in list_facts(rows)], dtype=bool)
    overshoot = np.asarray(rows["overshoot"])
    place, words = pd.factorize(np.asarray(rows["situation"], dtype=object))
    least = np.full(len(words), math.inf, dtype=overshoot.dtype)
    np.fmin.at(least, place[is_compared], overshoot[is_compared])
    return overshoot > least[place] + more


def meets_but_overshoot(rows: Mapping[Any, Any], rule: Rule = RULE) -> np.ndarray:
    """Return whether the law of each row meets the requirements of a rule other than that of its overshoot."""
    facts = list_facts(rows)
    memory = np.array([fact.memory for fact in facts], dtype=int)
    has = np.isfinite(np.asarray(rows[rule.by], dtype=float))
    if rule.everywhere:
        has &= np.asarray(rows["lost"]) == 0
        # Exact 180° rotations hold every continuous law without memory.
        has &= rule.continuous | (np.asarray(rows["stuck"]) == 0)
    if rule.direct:
        has &= np.asarray(rows["unwound"]) == 0
    if rule.adversary and not (rule.forgetful or rule.continuous):
        has &= np.asarray(rows["trapped"]) == 0
    if rule.forgetful or rule.continuous:
        has &= memory == 0
    if rule.continuous:
        has &= np.array([fact.is_continuous for fact in facts], dtype=bool)
    return has


def find_beaten(rows: Mapping[Any, Any], rule: Rule, pairs: Mapping[Any, Any] | None = None) -> np.ndarray:
    """Return whether the law of row i is beaten by that of row j, shape (n, n).

    The median, the 99.9 % time and the effort have no interval: there the share `tie` alone decides.
    """
    if rule.by in PAIRED and pairs is not None:
        return find_slower(pairs, [str(law) for law in np.asarray(rows["contender"], dtype=object)], rule.tie)
    times = np.asarray(rows[rule.by], dtype=float)
    is_notable = times[None, :] < (1.0 - rule.tie) * times[:, None]
    if rule.by != "time":
        return is_notable
    low, high = np.asarray(rows["time_low"], dtype=float), np.asarray(rows["time_high"], dtype=float)
    return is_notable & (high[None, :] < low[:, None])


@functools.cache
def group_map(folder: Path = STUDY) -> dict[Situation, pd.DataFrame]:
    """Return the rows of each situation of a map."""
    groups = read_map(folder).groupby("situation", sort=False, observed=True)
    return {read_situation(str(word)): rows for word, rows in groups}


@functools.cache
def _group_columns(folder: Path) -> dict[Situation, dict[str, np.ndarray]]:
    return {read_situation(word): rows for word, rows in split(read_map(folder)).items()}


@functools.cache
def decide_at(at: Situation, folder: Path = STUDY, rule: Rule = RULE) -> RuleVerdict:
    """Return the rule's verdict on one situation of a map."""
    return _decide(_group_columns(folder)[at], rule, read_pair_columns(folder).get(at.word))


@functools.cache
def decide_all(folder: Path = STUDY, rule: Rule = RULE) -> dict[Situation, RuleVerdict]:
    """Return the rule's verdict on every situation of a map."""
    return {at: decide_at(at, folder, rule) for at in group_map(folder)}


def is_drawn(at: Situation) -> bool:
    """Tell whether a situation was drawn at random: it differs from the nominal one in several numbers beside zeta."""
    return sum(value != one.nominal for value, one in zip(at[1:], list(COORDINATES.values())[1:], strict=True)) > 1


class Region(NamedTuple):
    """A law, the share of the drawn situations in which it is advised, and the share in which nothing beats it."""

    law: str
    advised: float
    unbeaten: float


def find_regions(folder: Path = STUDY, rule: Rule = RULE, some: Sequence[Situation] | None = None) -> list[Region]:
    """Return the region of each advised law, the widest first."""
    # Only these are decided: a map has three times as many situations, and to decide all takes seconds.
    drawn = [decide_at(at, folder, rule) for at in (some or group_map(folder)) if is_drawn(at)]
    advised = collections.Counter(one.law for one in drawn if one.law)
    unbeaten = collections.Counter(law for one in drawn for law in one.unbeaten)
    found = [Region(law, count / len(drawn), unbeaten[law] / len(drawn)) for law, count in advised.items()]
    return sorted(found, key=lambda one: (-one.advised, one.law))


def find_default(folder: Path = STUDY, rule: Rule = RULE) -> str:
    """Return the law of the widest region."""
    return find_regions(folder, rule)[0].law


def list_ours(folder: Path = STUDY) -> list[str]:
    """Return our own laws of the map."""
    return [str(law) for law in read_map(folder)["contender"].unique() if facts_of(str(law)).is_ours]
