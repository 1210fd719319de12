"""C31 and C35: how far and how fast the three regulators settle, from rest (Murphy 1988, 2.5 and 4)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bench.findings.claims.adequacy import THREE
from bench.findings.claims.at_gains import RULE, at_every_gain
from bench.findings.claims.tables import MAIN_ENGINE, Share, evidence, settled, share
from bench.findings.claims.verdict import Earlier, Word, claim, word_of
from bench.findings.theory import closed_form
from bench.tables.statistics import bootstrap, quantile, quantile_estimate

if TYPE_CHECKING:
    import pandas as pd

NEARLY_ALL, DRAMATIC = 0.99, 2.0
"""The quantile that stands for 'the range', and the factor in time from which an improvement is dramatic."""

REASONABLE, PACE = 0.99, 2.0
"""Share that settles, and the factor over the time of a small error, in the median: from there on it is reasonable."""


def _of_the_three(results) -> list[pd.DataFrame]:
    """Uniform starts from rest of each law, the same in the same order; one that does not converge settles nowhere."""
    found = [results.episodes(name.partition("/")[0], MAIN_ENGINE, "uniform") for name in THREE]
    found = [one.assign(outcome=one["outcome"].astype(str).where(one["converged"] != "no", "unknown")) for one in found]
    common = set.intersection(*(set(one["start_id"]) for one in found))
    return [one[one["start_id"].isin(common)].sort_values("start_id", kind="stable") for one in found]


def _times(rows: pd.DataFrame) -> np.ndarray:
    """Settling times, infinite where it does not settle."""
    return rows["settling_time_s"].where(settled(rows), np.inf).to_numpy(float)


@claim(
    id="C31",
    section="2.5",
    quote="""
        Using the feedback linearized regulator dramatically improved the performance of the system over the largest
        range of initial orientations.
    """,
    correction="It is faster over the same range as the rotation-matrix law; its range is not larger than that.",
    instead="""
        At all gains tried it is faster over the range of the rotation-matrix law; by how much depends on the gains.
    """,
    written="2026-11-24 fb18d38",
    sentence="Feedback linearization dramatically improved the performance, over the largest range of orientations.",
    question="Does it settle from more starts than the other two, and how much sooner?",
    criterion=f"""
        Uniform starts from rest, goal zero, the same for the three. Range: the share that settles, with its 95 %
        interval; larger than another if the intervals part, smaller if they part the other way. Performance: the time
        in which {NEARLY_ALL:.0%} settle (infinite where fewer do), the other's over its own; dramatically better if the
        ratio is at least {DRAMATIC:g} by the lower end of its interval (paired bootstrap). It holds if it is
        dramatically better than both others and its range is larger than both; with a correction if it is dramatically
        better than both, its range larger than the linearized law's and not smaller than the rotation-matrix law's;
        otherwise it does not hold. {RULE}
    """,
    earlier=(
        Earlier(
            "2026-11-23 bc126c2",
            "Decided at the run's gains alone; the paper gives none for the first law, and others give another word.",
            Word.CORRECTED,
        ),
    ),
    open="'Dramatically' has no number. Points of the boundary itself are left out, as the paper's next sentence does.",
)
@at_every_gain
def c31(results):
    """Shares that settle, and ratios of the time in which nearly all do."""
    *others, own = _of_the_three(results)
    ranges = [share(settled(one)) for one in (*others, own)]
    ratios = [_gain(_times(own), _times(one)) for one in others]
    is_dramatic = all(ratio.low >= DRAMATIC for ratio in ratios)
    matrix, linearized, mine = ranges
    larger, beside = mine.low > linearized.high, mine.high >= matrix.low
    word = word_of(is_dramatic and larger and mine.low > matrix.high, is_dramatic and larger and beside)
    told = ", ".join(f"{_law(name)} {one}" for name, one in zip(THREE, ranges, strict=True))
    sooner = ", ".join(
        f"{_law(name)} {ratio.value:.2f} ({ratio.low:.2f} to {ratio.high:.2f})"
        for name, ratio in zip(THREE, ratios, strict=False)
    )
    return word, evidence(
        f"""Settled: {told}. Time in which {NEARLY_ALL:.0%} settle over that of feedback linearization: {sooner}.""",
        3 * len(own),
        ("episodes",),
    )


def _gain(own: np.ndarray, other: np.ndarray):
    """The other's time in which nearly all settle over its own; resampled by starts."""

    def ratio(drawn, axis):
        quantiles = quantile(drawn, NEARLY_ALL, axis=-2)
        with np.errstate(invalid="ignore"):
            ratios = quantiles[..., 1] / quantiles[..., 0]
        return np.where(np.isnan(ratios), 1.0, ratios)  # neither settles

    return bootstrap(np.stack([own, other], axis=1), ratio)


@claim(
    id="C35",
    section="4",
    quote="Reasonable performance was achieved with two of the regulators",
    value="two",
    correction="It was achieved with all three.",
    written="2026-11-23 bc126c2",
    sentence="Two of the three regulators perform reasonably.",
    question="How many of the three settle from nearly everywhere, and in what time?",
    criterion=f"""
        Uniform starts from rest, goal zero. Reasonable: at least {REASONABLE:.0%} settle, by the lower end of the 95 %
        interval, and the median settling time is at most {PACE:g} times that of a small error, by the upper end of its
        interval (bootstrap). It holds if exactly two of the three are reasonable; with a correction if all three are;
        otherwise it does not hold.
    """,
    open="Which two is not said; by 2.5 they are the rotation-matrix and the feedback-linearized law.",
)
def c35(results):
    """Shares and medians of the three."""
    small, found = closed_form.linear_settling(*results.gains()), {}
    for name, rows in zip(THREE, _of_the_three(results), strict=True):
        found[_law(name)] = (share(settled(rows)), quantile_estimate(_times(rows), 0.5))
    reasonable = [name for name, (kept, time) in found.items() if kept.low >= REASONABLE and time.high <= PACE * small]
    word = {2: Word.HOLDS, 3: Word.CORRECTED}.get(len(reasonable), Word.FAILS)
    told = "; ".join(f"{name} {_told(*one)}" for name, one in found.items())
    return word, evidence(
        f"""Reasonable: {", ".join(reasonable) or "none"}. {told}. A small error settles in {small:.3f} s.""",
        sum(kept.n for kept, _ in found.values()),
        ("episodes",),
    )


def _told(kept: Share, time) -> str:
    return f"{kept}, in {time.value:.3f} s ({time.low:.3f} to {time.high:.3f}) in the median"


def _law(name: str) -> str:
    return name.partition("/")[0]
