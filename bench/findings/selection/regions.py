"""The law that nothing beats in a situation, by the rows of results/situations, and the regions that such laws have.

The rule was committed before the map was run:

1. Asked are the laws that settle from every start tried, exact 180° rotations among them, that never first turn away
   from the goal, and that worst-case noise of 0.1 rad does not trap at 180° (`Rule` drops each of these).
2. One law beats another in a situation if 99 % of its starts settle in a time that is shorter by more than NOTABLE, and
   the 95 % intervals of the two times do not overlap. All else is a tie.
3. The simplest of the laws that nothing beats is advised: of least memory, then of fewest operations.
4. A law of ours is never advised; where it is not beaten, or beats what is advised, that is said.
5. The default is the law with the widest region: advised in most of the situations that were drawn at random.
"""

import collections
import functools
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from bench.experiments.tables.read import with_contender
from bench.experiments.tables.schema import RESULTS
from bench.experiments.tables.store import read
from bench.findings.selection.criteria import NOTABLE, jump
from bench.law.contenders.registry import find_contender
from tasks.situation import COORDINATES, NOMINAL, Situation, read_situation

STUDY = RESULTS / "situations"
"""What `python -P -m bench.studies.situations` keeps."""

NAMES = list(COORDINATES)

CONTINUOUS = 1e-3
"""Jump of the command over kp [rad] below which it is the slope's: f'(pi) 2e-6 of any law here."""

NEIGHBOURS = 8
"""Nearest situations whose laws say how sure an answer between the rows is."""


class Rule(NamedTuple):
    """What a law must have, and what decides; the defaults are the rule above.

    everywhere: no start is lost, no exact 180° rotation holds it. direct: it never first turns away from the goal.
    adversary: worst-case noise does not trap it. forgetful: it keeps nothing from tick to tick. continuous: its command
    does not jump at 180°; exact 180° rotations may hold such a law, for all that keep nothing have some.
    by: the column that is compared. tie: the relative difference up to which two laws tie. least_peak: of the laws that
    tie, the one of least peak command is advised.
    """

    everywhere: bool = True
    direct: bool = True
    adversary: bool = True
    forgetful: bool = False
    continuous: bool = False
    by: str = "time"
    tie: float = NOTABLE
    least_peak: bool = False


RULE = Rule()


class Verdict(NamedTuple):
    """What the rule makes of a situation.

    law: the one that is advised, None if none is left. tied: the others that nothing beats, the simplest first. ours:
    our own laws that nothing published beats. faster: those of them that beat the advised one. asked: how many laws
    have what is required.
    """

    law: str | None
    tied: tuple[str, ...] = ()
    ours: tuple[str, ...] = ()
    faster: tuple[str, ...] = ()
    asked: int = 0

    @property
    def unbeaten(self) -> frozenset[str]:
        """The advised law and those that tie with it."""
        return frozenset((self.law, *self.tied) if self.law else ())


class Facts(NamedTuple):
    """What a law has in every situation: numbers kept, whether its command jumps at 180°, whether it is ours."""

    memory: int
    is_continuous: bool
    is_ours: bool


@functools.cache
def facts_of(law: str) -> Facts:
    """Return the facts of a law of this repository."""
    one = find_contender(law)
    return Facts(len(one.regulator.memory or ()), abs(jump(one)) < CONTINUOUS, one.regulator.is_ours())


@functools.cache
def read_map(folder: Path = STUDY) -> pd.DataFrame:
    """Return the rows of a map, `with_words`."""
    return with_words(read(folder, "situations"))


def with_words(rows: pd.DataFrame) -> pd.DataFrame:
    """Return rows of situations.parquet with `contender` and `situation`, the word of each row's situation."""
    words = [Situation(*values).word for values in rows[NAMES].itertuples(index=False, name=None)]
    return with_contender(rows).assign(situation=words)


def decide(rows: pd.DataFrame, rule: Rule = RULE) -> Verdict:
    """Apply the rule to the rows of one situation, a law each."""
    laws = rows["contender"].astype(str).to_numpy()
    memory, is_continuous, is_ours = np.array([facts_of(law) for law in laws]).T
    has = np.isfinite(rows[rule.by].to_numpy(dtype=float))
    if rule.everywhere:
        has &= (rows["lost"] == 0).to_numpy() & (rule.continuous | (rows["stuck"] == 0).to_numpy())
    if rule.direct:
        has &= (rows["unwound"] == 0).to_numpy()
    if rule.adversary and not (rule.forgetful or rule.continuous):
        has &= (rows["trapped"] == 0).to_numpy()
    if rule.forgetful or rule.continuous:
        has &= memory == 0
    if rule.continuous:
        has &= is_continuous == 1
    asked, own, is_ours = rows[has].assign(memory=memory[has]), laws[has], is_ours[has] == 1
    if is_ours.all():  # or none is left
        return Verdict(None, ours=tuple(own))
    beaten = find_beaten(asked, rule)
    by_published = beaten[:, ~is_ours].any(axis=1)
    order = ["peak"] if rule.least_peak else []
    kept = asked[~is_ours & ~by_published].sort_values([*order, "memory", "operations", "contender"])
    law, *tied = kept["contender"].astype(str)
    faster = own[is_ours & beaten[own.tolist().index(law)]]
    return Verdict(law, tuple(tied), tuple(own[is_ours & ~by_published]), tuple(faster), len(asked))


def find_beaten(rows: pd.DataFrame, rule: Rule) -> np.ndarray:
    """Return whether the law of row i is beaten by that of row j, shape (n, n).

    The median and the 99.9 % time have no interval of their own: there the share `tie` alone decides.
    """
    times = rows[rule.by].to_numpy(dtype=float)
    is_notable = times[None, :] < (1.0 - rule.tie) * times[:, None]
    if rule.by != "time":
        return is_notable
    low, high = rows["time_low"].to_numpy(dtype=float), rows["time_high"].to_numpy(dtype=float)
    return is_notable & (high[None, :] < low[:, None])


@functools.lru_cache(maxsize=64)
def decide_all(folder: Path = STUDY, rule: Rule = RULE) -> dict[Situation, Verdict]:
    """Return the rule's verdict on every situation of a map."""
    return {
        read_situation(str(word)): decide(rows, rule)
        for word, rows in read_map(folder).groupby("situation", sort=False, observed=True)
    }


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
    verdicts = decide_all(folder, rule)
    drawn = [verdicts[at] for at in (some or verdicts) if is_drawn(at)]
    advised = collections.Counter(one.law for one in drawn if one.law)
    unbeaten = collections.Counter(law for one in drawn for law in one.unbeaten)
    found = [Region(law, count / len(drawn), unbeaten[law] / len(drawn)) for law, count in advised.items()]
    return sorted(found, key=lambda one: (-one.advised, one.law))


def find_default(folder: Path = STUDY, rule: Rule = RULE) -> str:
    """Return the law of the widest region."""
    return find_regions(folder, rule)[0].law


def find_bounds(law: str, folder: Path = STUDY, rule: Rule = RULE) -> dict[str, list[tuple[float, bool]]]:
    """Return, along each line through the nominal situation, the values that were run and whether nothing beats it."""
    verdicts = decide_all(folder, rule)
    found: dict[str, list[tuple[float, bool]]] = {}
    for name, nominal in zip(NAMES, NOMINAL, strict=True):
        line = [at for at in verdicts if at._replace(**{name: nominal}) == NOMINAL]
        found[name] = sorted((getattr(at, name), law in verdicts[at].unbeaten) for at in line)
    return found


def compare_ours(law: str, folder: Path = STUDY, rule: Rule = RULE) -> tuple[float, float]:
    """Return the shares of drawn situations in which nothing published beats our law, and it beats the advised one."""
    drawn = [one for at, one in decide_all(folder, rule).items() if is_drawn(at)]
    return sum(law in one.ours for one in drawn) / len(drawn), sum(law in one.faster for one in drawn) / len(drawn)


def list_ours(folder: Path = STUDY) -> list[str]:
    """Return our own laws of the map."""
    return [str(law) for law in read_map(folder)["contender"].unique() if facts_of(str(law)).is_ours]
