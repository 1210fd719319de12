"""How the advice depends on the rule, on the draw of the situations, and on how many comparisons are made."""

import functools
import math
from pathlib import Path
from typing import NamedTuple

import numpy as np

from bench.findings.selection import regions
from bench.findings.selection.advice import answer
from bench.findings.selection.regions import RULE, STUDY, Rule, decide_all, find_default, find_regions, read_map
from tasks.situation import NOMINAL, Situation, read_situation

RULES = {  # ours, and those that a critic would choose
    "the rule": RULE,
    "a law may fail from some starts": Rule(everywhere=False),
    "unwinding is allowed": Rule(direct=False),
    "noise is left out": Rule(adversary=False),
    "no memory": Rule(forgetful=True),
    "a continuous command": Rule(continuous=True),
    "the median time decides": Rule(by="median"),
    "the 99.9 % time decides": Rule(by="latest"),
    "times within 5 % are equal": Rule(tie=0.05),
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


def correct(folder: Path = STUDY) -> tuple[int, int]:
    """Return how many comparisons of the map the advised law wins, and how many are left if all are corrected at once.

    By S. Holm, Scand. J. Statist. 6, 1979. A difference of two 99 % times has the standard error that their 95 %
    intervals give, as for independent starts; p is two-sided.
    """
    from scipy.stats import norm

    p_values: list[float] = []
    for word, rows in read_map(folder).groupby("situation", observed=True):
        one = decide_all(folder)[read_situation(str(word))]
        if one.law is None:
            continue
        names, times = rows["contender"].astype(str), rows["time"]
        own = rows[names == one.law].iloc[0]
        is_beaten = np.isfinite(times) & (own["time_high"] < rows["time_low"]) & ~names.isin(one.unbeaten)
        beaten = rows[is_beaten & (own["time"] < (1.0 - RULE.tie) * times)]
        errors = ((each["time_high"] - each["time_low"]) / 3.92 for each in (own, beaten))
        p_values += (2.0 * norm.sf((beaten["time"] - own["time"]) / np.hypot(*errors).clip(1e-12))).tolist()
    return len(p_values), count_rejected(np.array(p_values))


def count_rejected(p_values: np.ndarray, level: float = LEVEL) -> int:
    """Return how many hypotheses Holm's step-down procedure rejects."""
    ordered = np.sort(p_values)
    limits = level / np.arange(len(ordered), 0, -1)
    passed = ordered <= limits
    return int(len(ordered) if passed.all() else np.argmin(passed))


def bound_slower(starts: int) -> float:
    """Return the share of starts that may be slower than the slowest of so many, at most, with 95 % confidence.

    1 - 0.05^(1/n): none of n draws exceeds what a greater share exceeds, but with a chance below 5 % (S. Wilks, Ann.
    Math. Statist. 12, 1941).
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


def count_agreeing(folder: Path = STUDY) -> dict[str, float]:
    """Compare the answers of the map with the held-out situations, which were run once.

    Return of: how many; same: share whose nearest row advises the law that their own rows do; what `rate` returns of
    the map's answers and, after "always_", of the default in every situation.
    """
    verdicts = decide_all(folder / "held-out")
    given = {at: answer(at, RULE, folder).verdict.law for at in verdicts}
    always = rate(dict.fromkeys(verdicts, find_default(folder)), folder)
    return {
        "of": len(verdicts),
        "same": sum(given[at] == truth.law for at, truth in verdicts.items()) / len(verdicts),
        **rate(given, folder),
        **{f"always_{key}": value for key, value in always.items()},
    }


def rate(given: dict[Situation, str | None], folder: Path) -> dict[str, float]:
    """Return how good an advice is in the held-out situations.

    unbeaten: share in which nothing beats the advised law; half, most: median and 95 % of the time that the advised law
    takes longer than the fastest published law that meets the requirements.
    """
    rows, verdicts, later = read_map(folder / "held-out"), decide_all(folder / "held-out"), []
    for at, truth in verdicts.items():
        times = rows[rows["situation"] == at.word].set_index("contender")["time"]
        best = min((times[law] for law in truth.unbeaten if not regions.facts_of(law).is_ours), default=math.nan)
        later.append(times.get(given[at], math.inf) / best - 1.0 if truth.law else math.nan)
    some = np.array([one for one in later if one == one])
    unbeaten = sum(given[at] in truth.unbeaten or given[at] is truth.law for at, truth in verdicts.items())
    return {
        "unbeaten": unbeaten / len(verdicts),
        "half": float(np.quantile(some, 0.5)),
        "most": float(np.quantile(some, 0.95, method="inverted_cdf")),
    }
