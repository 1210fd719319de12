"""How the advice depends on the rule, on the draw of the situations, and on how many comparisons are made."""

import functools
import math
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from bench.findings.selection import regions
from bench.findings.selection.nearest import answer
from bench.findings.selection.pairs import compare_with_all
from bench.findings.selection.regions import RULE, STUDY, Rule, decide_all, find_default, find_regions, read_map
from bench.findings.selection.unbeaten import SPOKEN, SituationShare, compare_everywhere
from tasks.situation import NOMINAL, Situation, read_situation

RULES = {  # ours, and those that a critic would choose
    "the rule": RULE,
    "a law may fail from some starts": Rule(everywhere=False),
    "unwinding is allowed": Rule(direct=False),
    "noise is left out": Rule(adversary=False),
    "overshoot is left out": Rule(overshoot=math.inf),
    "an overshoot of 2° more is too much": Rule(overshoot=2.0),
    "no memory": Rule(forgetful=True),
    "a continuous command": Rule(continuous=True),
    "the median time decides": Rule(by="median"),
    "the 99.9 % time decides": Rule(by="latest"),
    "times within 1 % are equal": Rule(tie=0.01),
    "times within 10 % are equal": Rule(tie=0.1),
    "of equally fast laws, the one with the least peak command is advised": Rule(least_peak=True),
    "the least effort decides": Rule(by="effort"),
}
HALVES, SEED = 100, 1988
LEVEL = 0.05


class Varied(NamedTuple):
    """What a rule advises: the law of the widest region, its share of the drawn situations, and those that change.

    changed: share of the drawn situations whose advised law is another than by the rule.
    """

    words: str
    law: str
    advised: float
    unbeaten: float
    changed: float


@functools.cache
def vary(folder: Path = STUDY) -> tuple[Varied, ...]:
    """Return what each of RULES advises."""
    usual, found = decide_all(folder), []
    for words, rule in RULES.items():
        widest, verdicts = find_regions(folder, rule)[0], decide_all(folder, rule)
        drawn = [at for at in usual if regions.is_drawn(at)]
        changed = sum(verdicts[at].law != usual[at].law for at in drawn) / len(drawn)
        found.append(Varied(words, widest.law, widest.advised, widest.unbeaten, changed))
    return tuple(found)


def count_halves(folder: Path = STUDY) -> tuple[int, int]:
    """Return in how many random halves of the drawn situations the default is the same, and of how many."""
    drawn, default = [at for at in decide_all(folder) if regions.is_drawn(at)], find_default(folder)
    rng = np.random.default_rng(SEED)
    halves = (rng.permutation(len(drawn))[: len(drawn) // 2] for _ in range(HALVES))
    return sum(find_regions(folder, RULE, [drawn[i] for i in half])[0].law == default for half in halves), HALVES


class Corrected(NamedTuple):
    """Comparisons of the advised law of every situation with every other law of the map there, corrected all at once.

    compared: all that have a finite ratio; winners, ties and losers alike. different: those whose ratio is still not 1
    after the correction. won: of these, the advised law is faster by more than the tie of the rule. lost: it is slower
    by more. won_before, lost_before: by the paired interval of each comparison alone.
    """

    compared: int
    different: int
    won: int
    lost: int
    won_before: int
    lost_before: int


@functools.cache
def correct(folder: Path = STUDY) -> Corrected:
    """Correct all comparisons of advised laws by S. Holm, Scand. J. Statist. 6, 1979.

    p is two-sided, by the paired standard error of the ratio's logarithm; where a resample has an infinite time, there
    is no such error, and the comparison counts as not different.
    """
    from scipy.stats import norm

    advised = [(situation.word, verdict.law) for situation, verdict in decide_all(folder).items() if verdict.law]
    frames = []
    for law in sorted({law for _, law in advised}):
        words = {word for word, other in advised if other == law}
        pairs = compare_with_all(law, folder)
        frames.append(pairs[pairs["situation"].isin(words) & np.isfinite(pairs["log_ratio"])])
    family = pd.concat(frames, ignore_index=True)
    ratio, error = family["log_ratio"].to_numpy(dtype=float), family["error"].to_numpy(dtype=float)
    p_values = np.where(np.isnan(error), 1.0, 2.0 * norm.sf(np.abs(ratio) / np.maximum(error, TINY)))
    is_different = reject(p_values)
    # A positive ratio says that the other law is faster.
    is_won, is_lost = ratio < math.log1p(-RULE.tie), ratio > -math.log1p(-RULE.tie)
    return Corrected(
        len(family),
        int(is_different.sum()),
        int((is_different & is_won).sum()),
        int((is_different & is_lost).sum()),
        int((is_won & (family["high"] < 0.0)).sum()),
        int((is_lost & (family["low"] > 0.0)).sum()),
    )


TINY = 1e-12
"""Least standard error: that of laws whose resamples all have the same ratio is zero."""


def reject(p_values: np.ndarray, level: float = LEVEL) -> np.ndarray:
    """Return which hypotheses Holm's step-down procedure rejects."""
    is_rejected = np.zeros(len(p_values), dtype=bool)
    is_rejected[np.argsort(p_values, kind="stable")[: count_rejected(p_values, level)]] = True
    return is_rejected


def count_rejected(p_values: np.ndarray, level: float = LEVEL) -> int:
    """Return how many hypotheses Holm's step-down procedure rejects."""
    ordered = np.sort(p_values)
    limits = level / np.arange(len(ordered), 0, -1)
    passed = ordered <= limits
    return int(len(ordered) if passed.all() else np.argmin(passed))


def bound_slower(starts: int) -> float:
    """Return the share of starts that may be slower than the slowest of so many, at most, with 95 % confidence.

    1 - 0.05^(1/n): none of n independent draws exceeds what a greater share exceeds, but with a chance below 5 % (S.
    Wilks, Ann. Math. Statist. 12, 1941). The starts of a situation are such draws (`Situation.starts`).
    """
    return 1.0 - 0.05 ** (1.0 / starts)


class Tuned(NamedTuple):
    """A law tuned for itself. zeta, time: the best damping ratio at equal kp, and the 99 % time in 1/sqrt(kp).

    peak_zeta, peak_time: the best damping ratio where kp is what a peak command allows, and the time in 1/sqrt(peak).
    at_one: the time at zeta = 1.
    """

    law: str
    zeta: float
    time: float
    peak_zeta: float
    peak_time: float
    at_one: float


def tune(folder: Path = STUDY) -> list[Tuned]:
    """Return every law that settles from everywhere, tuned along the nominal line of damping ratios, by its time."""
    rows, found = read_map(folder), []
    line = rows[[read_situation(str(word))._replace(zeta=1.0) == NOMINAL for word in rows["situation"]]]
    for law, own in line.groupby("contender", observed=True):
        own = own.sort_values("zeta")
        if not (own["lost"].any() or own["stuck"].any()):
            by_peak = own["time"] * np.sqrt(own["peak"])
            best, at_peak = own.loc[own["time"].idxmin()], own.loc[by_peak.idxmin()]
            at_one = float(own.loc[own["zeta"] == 1.0, "time"].iloc[0])
            found.append(Tuned(str(law), best["zeta"], best["time"], at_peak["zeta"], by_peak.min(), at_one))
    return sorted(found, key=lambda one: one.time)


class Rated(NamedTuple):
    """How good an advice is in the held-out situations.

    qualified, all: share in which the advised law meets the requirements and no law of that set (`unbeaten`) is faster,
    or no law is advised and none should be. slower: share in which a qualified law is faster by more than SPOKEN.
    half, most: median and 95 % of the share of time that the advised law takes longer than the fastest qualified law.
    """

    qualified: SituationShare
    all: SituationShare
    slower: SituationShare
    half: float
    most: float


class Agreement(NamedTuple):
    """The map's answers against the held-out situations, which were run once.

    same: share whose nearest row of the map advises the law that their own rows do. map: how good the map's answers
    are. default: how good the default is, advised everywhere.
    """

    same: SituationShare
    map: Rated
    default: Rated


@functools.cache
def count_agreeing(folder: Path = STUDY) -> Agreement:
    """Compare the answers of the map with the held-out situations, drawn as the map's are by another seed."""
    verdicts = decide_all(folder / "held-out")
    answers = {at: answer(at, RULE, folder).verdict.law for at in verdicts}
    same = sum(answers[at] == verdict.law for at, verdict in verdicts.items())
    default: dict[Situation, str | None] = dict.fromkeys(verdicts, find_default(folder))
    return Agreement(
        SituationShare(same, len(verdicts)), rate(answers, folder), rate(default, folder)
    )


def rate(answers: dict[Situation, str | None], folder: Path) -> Rated:
    """Return how good answers are in the held-out situations."""
    held_out = folder / "held-out"
    rows, verdicts = read_map(held_out), decide_all(held_out)
    counts = {"qualified": 0, "all": 0, "slower": 0}
    longer = []
    for situation, verdict in verdicts.items():
        law = answers[situation]
        if law is None or verdict.law is None:
            is_right = law is verdict.law
            counts["qualified"] += is_right
            counts["all"] += is_right
        else:
            standing = compare_everywhere(law, held_out)[situation]
            spoken = compare_everywhere(law, held_out, tie=SPOKEN)[situation]
            counts["qualified"] += standing.is_unbeaten(among_all=False)
            counts["all"] += standing.is_unbeaten(among_all=True)
            counts["slower"] += not spoken.is_unbeaten(among_all=False)
        if verdict.law is not None:
            times = rows[rows["situation"] == situation.word].set_index("contender")["time"]
            best = min(times[name] for name in verdict.unbeaten)
            longer.append(times.get(law, math.inf) / best - 1.0)
    shares = {name: SituationShare(count, len(verdicts)) for name, count in counts.items()}
    half, most = (float(np.quantile(longer, level, method="inverted_cdf")) for level in (0.5, 0.95))
    return Rated(shares["qualified"], shares["all"], shares["slower"], half, most)
