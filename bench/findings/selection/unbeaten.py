"""In how many situations no other law is faster than a law, among two sets of laws that every sentence names.

Qualified: the laws that meet the requirements in the situation. All: every published or adapted law of the map, whether
or not it meets them there; a law of ours is in neither. A law that does not meet the requirements itself counts as
beaten in both.
"""

import functools
import math
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from bench.findings.selection import regions
from bench.findings.selection.pairs import compare_with_all
from bench.findings.selection.regions import RULE, STUDY, TIE, Rule, facts_of, find_regions, is_drawn, read_map
from tasks.situation import NOMINAL, Situation, read_situation

SPOKEN = TIE
"""A law is called faster in a sentence only if it is so by more than this share."""


class Rival(NamedTuple):
    """A law that is faster than another one in a situation.

    faster: by this share of the other's 99 % time. qualified: it meets the requirements there.
    """

    law: str
    faster: float
    qualified: bool


class SituationStanding(NamedTuple):
    """How a law stands in a situation. meets: it meets the requirements. lost: starts that it loses.

    rivals: published and adapted laws that are faster by more than the tie, and not by chance; the fastest first.
    """

    meets: bool
    lost: int
    rivals: tuple[Rival, ...]

    def is_unbeaten(self, among_all: bool) -> bool:
        """Tell whether the law meets the requirements and no law of the set is faster."""
        return self.meets and not any(among_all or rival.qualified for rival in self.rivals)


@functools.lru_cache(maxsize=256)
def compare_everywhere(
    law: str, folder: Path = STUDY, rule: Rule = RULE, tie: float | None = None
) -> dict[Situation, SituationStanding]:
    """Return how a law stands in every situation of a map; tie: the rule's if None."""
    notable = -math.log1p(-(rule.tie if tie is None else tie))
    rows = read_map(folder)
    rows = rows.assign(meets=regions.meets(rows, rule), contender=rows["contender"].astype(str))
    pairs = compare_with_all(law, folder)
    is_faster = (pairs["log_ratio"] > notable) & (pairs["low"] > 0.0) & ~pairs["rival"].map(_is_ours)
    faster = pairs[is_faster].merge(
        rows[["situation", "contender", "meets"]],
        left_on=["situation", "rival"],
        right_on=["situation", "contender"],
    )
    rivals: dict[str, list[Rival]] = {}
    for row in faster.sort_values("log_ratio", ascending=False).to_dict("records"):
        share = -math.expm1(-row["log_ratio"])
        rivals.setdefault(row["situation"], []).append(Rival(row["rival"], share, bool(row["meets"])))
    found = {}
    for row in rows[rows["contender"] == law].to_dict("records"):
        word = row["situation"]
        found[read_situation(word)] = SituationStanding(
            bool(row["meets"]), int(row["lost"]), tuple(rivals.get(word, ()))
        )
    return found


def _is_ours(law: str) -> bool:
    return facts_of(law).is_ours


class SituationShare(NamedTuple):
    """So many of so many situations."""

    number: int
    of: int

    @property
    def value(self) -> float:
        """The share."""
        return self.number / self.of

    @property
    def interval(self) -> tuple[float, float]:
        """The exact 95 % interval for situations drawn independently (C. Clopper, E. Pearson, Biometrika 26, 1934)."""
        from scipy.stats import binomtest

        interval = binomtest(self.number, self.of).proportion_ci(0.95, method="exact")
        return float(interval.low), float(interval.high)

    def __str__(self) -> str:
        """Return the share with its interval in per cent."""
        low, high = self.interval
        return f"{100 * self.value:.0f} % ({100 * low:.0f} to {100 * high:.0f} %)"


class Shares(NamedTuple):
    """Shares of the drawn situations. qualified, all: no law of that set is faster than the law, which meets all asked.

    failing: the law fails a requirement. losing: it loses starts.
    """

    qualified: SituationShare
    all: SituationShare
    failing: SituationShare
    losing: SituationShare


def measure_shares(
    law: str,
    folder: Path = STUDY,
    rule: Rule = RULE,
    tie: float | None = None,
    some: Sequence[Situation] | None = None,
) -> Shares:
    """Return a law's shares of the drawn situations, or of some of these; tie: the rule's if None."""
    every = compare_everywhere(law, folder, rule, tie)
    drawn = [every[situation] for situation in (some or every) if is_drawn(situation)]
    counts = (
        sum(standing.is_unbeaten(among_all=False) for standing in drawn),
        sum(standing.is_unbeaten(among_all=True) for standing in drawn),
        sum(not standing.meets for standing in drawn),
        sum(standing.lost > 0 for standing in drawn),
    )
    return Shares(*(SituationShare(count, len(drawn)) for count in counts))


class Population(NamedTuple):
    """The published and adapted laws of the map.

    qualified: those that meet the requirements in some drawn situation. excluded: those that meet them in none.
    """

    qualified: tuple[str, ...]
    excluded: tuple[str, ...]


@functools.lru_cache(maxsize=16)
def find_population(folder: Path = STUDY, rule: Rule = RULE) -> Population:
    """Return which laws are compared as qualified somewhere, and which are excluded everywhere."""
    rows = read_map(folder)
    drawn = {word for word in rows["situation"].unique() if is_drawn(read_situation(str(word)))}
    rows = rows[rows["situation"].isin(drawn)]
    has = pd.Series(regions.meets(rows, rule), index=rows["contender"].astype(str))
    anywhere = has.groupby(level=0).any()
    laws = [law for law in anywhere.index if not facts_of(law).is_ours]
    return Population(
        tuple(law for law in laws if anywhere[law]),
        tuple(law for law in laws if not anywhere[law]),
    )


def find_least_beaten(
    folder: Path = STUDY, rule: Rule = RULE, tie: float = SPOKEN
) -> tuple[str, SituationShare]:
    """Return the law that is unbeaten by qualified laws in most of the drawn situations, and in which share.

    Laws of ours are left out. The rule's default can be another law: where laws tie, it advises the simplest.
    """
    shares = {law: measure_shares(law, folder, rule, tie).qualified for law in find_population(folder, rule).qualified}
    law = max(shares, key=lambda name: (shares[name].number, name))
    return law, shares[law]


def count_rivals(
    law: str, among_all: bool, folder: Path = STUDY, rule: Rule = RULE, tie: float | None = None
) -> dict[str, SituationShare]:
    """Return in which share of the drawn situations each law of a set is faster than a law; the most often first."""
    every = compare_everywhere(law, folder, rule, tie)
    drawn = [standing for situation, standing in every.items() if is_drawn(situation)]
    counts: dict[str, int] = {}
    for standing in drawn:
        for rival in standing.rivals:
            if among_all or rival.qualified:
                counts[rival.law] = counts.get(rival.law, 0) + 1
    ordered = sorted(counts.items(), key=lambda item: (-item[1], item[0]))
    return {rival: SituationShare(count, len(drawn)) for rival, count in ordered}


class ValueOnLine(NamedTuple):
    """A value of one number of the nominal situation, the others kept, and how a law stands there."""

    value: float
    standing: SituationStanding


def follow_lines(
    law: str, folder: Path = STUDY, rule: Rule = RULE, tie: float | None = None
) -> dict[str, list[ValueOnLine]]:
    """Return how a law stands along each line through the nominal situation, by the name of the number that varies."""
    every = compare_everywhere(law, folder, rule, tie)
    lines: dict[str, list[ValueOnLine]] = {}
    for name, nominal in zip(regions.NAMES, NOMINAL, strict=True):
        line = [situation for situation in every if situation._replace(**{name: nominal}) == NOMINAL]
        places = [ValueOnLine(getattr(situation, name), every[situation]) for situation in line]
        lines[name] = sorted(places, key=lambda place: place.value)
    return lines


def find_bounds(
    law: str, among_all: bool = False, folder: Path = STUDY, rule: Rule = RULE, tie: float = SPOKEN
) -> dict[str, list[tuple[float, bool]]]:
    """Return the values along each line, and whether a law meets the requirements there and no law of a set is faster.

    For sentences: only what is faster by more than `tie` counts.
    """
    lines = follow_lines(law, folder, rule, tie)
    return {
        name: [(place.value, place.standing.is_unbeaten(among_all)) for place in places]
        for name, places in lines.items()
    }


def compare_with_advised(
    law: str, folder: Path = STUDY, rule: Rule = RULE, tie: float = SPOKEN
) -> SituationShare:
    """Return in which share of the drawn situations a law meets the requirements and is faster than the advised law."""
    standings = compare_everywhere(law, folder, rule)
    verdicts = regions.decide_all(folder, rule)
    pairs = compare_with_all(law, folder)
    is_faster = (pairs["log_ratio"] < math.log1p(-tie)) & (pairs["high"] < 0.0)
    beaten = set(zip(pairs.loc[is_faster, "situation"], pairs.loc[is_faster, "rival"], strict=True))
    drawn = [situation for situation in verdicts if is_drawn(situation)]
    count = 0
    for situation in drawn:
        count += standings[situation].meets and (situation.word, verdicts[situation].law) in beaten
    return SituationShare(count, len(drawn))


class Price(NamedTuple):
    """What a law costs in the nominal situation.

    peak: greatest command of all starts over kp [rad]. overshoot: what 1 % of the starts exceed [deg]. time: of 99 % of
    the starts [1/sqrt(kp)]. at_equal_peak: the same time where kp is what a peak command allows [1/sqrt(peak)].
    typical_peak, typical_overshoot: the medians over the drawn situations.
    """

    law: str
    peak: float
    overshoot: float
    time: float
    at_equal_peak: float
    typical_peak: float
    typical_overshoot: float


def find_price(law: str, folder: Path = STUDY) -> Price:
    """Return the price of a law."""
    rows = read_map(folder)
    rows = rows[rows["contender"] == law]
    [nominal] = rows[rows["situation"] == NOMINAL.word].to_dict("records")
    is_of_draw = [is_drawn(read_situation(str(word))) for word in rows["situation"]]
    drawn = rows[is_of_draw]
    return Price(
        law,
        nominal["peak"],
        nominal["overshoot"],
        nominal["time"],
        nominal["time"] * math.sqrt(nominal["peak"]),
        float(np.median(drawn["peak"])),
        float(np.median(drawn["overshoot"])),
    )


def find_runner_up(folder: Path = STUDY, rule: Rule = RULE) -> str | None:
    """Return the law of the second widest region."""
    others = find_regions(folder, rule)[1:]
    return others[0].law if others else None
