"""C12, C17, C27, C31, C35, C36: cost and performance of the paper's laws and later ones (Murphy 1988, 2.5 and 4)."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import Any

import numpy as np

from bench.base.on_first_use import pd
from bench.experiments.tables.statistics import bootstrap, quantile, quantile_estimate
from bench.findings.claims import adequacy, probes, tables
from bench.findings.claims.adequacy import PAPERS, THREE, Adequacy
from bench.findings.claims.at_gains import at_every_gain, on_every_engine
from bench.findings.claims.standing import ORDERED, Ledger
from bench.findings.claims.tables import MAIN_ENGINE, Results, evidence, interval, settled, settling_times, share, some
from bench.findings.claims.verdict import Evidence, NoEvidence, Word, claim, read_limits, word_of
from bench.findings.theory import closed_form

LIMIT = read_limits(__file__)


NAMES = [name.partition("/")[0] for name in THREE]


@claim("C12")
def c12(results: Results) -> tuple[Word, Evidence]:
    """Neighbours by time, and by flops and calls in both accountings."""
    known = adequacy.of_three(results)
    pairs = [known.stand(*pair) for pair in itertools.pairwise(THREE)]
    if not all(one.sign for one in pairs):
        raise NoEvidence("flops and calls say different things, and no time decides: run bench time")
    in_order = [one.sign == ORDERED and not one.is_disputed for one in pairs]
    paper, total = (
        ", ".join(f"{short} {one[name]}" for short, name in zip(NAMES, THREE, strict=True)) for one in known.accountings
    )
    timed = ", ".join(f"{short} {known.over(name, THREE[0])}" for short, name in zip(NAMES[1:], THREE[1:], strict=True))
    orders = [
        [short for _, short in sorted((one[name].flops, short) for short, name in zip(NAMES, THREE, strict=True))]
        for one in known.accountings
    ]
    others = [" < ".join(order) for order in orders if order != NAMES]
    literal = known.accountings[0].get(LIMIT.LITERAL)  # the law that is compared shares sines and folds Bdot
    as_printed = f"(2.15) as printed, term by term, takes {literal}." if literal else ""
    priced = f"; in these times a call takes {known.price:.0f} flops" if np.isfinite(known.price) else ""
    return word_of(all(in_order), all(np.logical_or(in_order, [one.is_disputed for one in pairs]))), evidence(
        f"""Time a tick over the rotation matrix's: {timed}; its intervals part
        {sum(bool(one.by_time) for one in pairs)} of {len(pairs)} pairs. Flops and calls: {paper}; with the goal's
        angles taken from its matrix: {total}; the columns decide {sum(0 not in one.by_columns for one in pairs)} of
        {len(pairs)} pairs{priced}. By flops alone, calls left out: {"; ".join(others) or "the same order"}.
        {as_printed}""",
        len(THREE) * (len(known.accountings) + len(known.times)),
        ("costs", "timings") if known.times else ("costs",),
    )


@claim("C17")
@at_every_gain
@on_every_engine
def c17(results: Results, engine: str) -> tuple[Word, Evidence]:
    """Return the three laws against the three tests of performance and the test of cost."""
    linear = closed_form.linear_settling(*results.gains())
    by_name = {one.name: one for one in adequacy.every(results, engine)}
    if not set(THREE) <= set(by_name):
        raise NoEvidence(f"not all of {', '.join(THREE)} ran by {engine}: run a suite without narrowing it")
    three, known = [by_name[name] for name in THREE], adequacy.of_three(results)
    lacks = [set(adequacy.missed(one, known, linear, {})) for one in three]
    both = {name: lack for name, lack in zip(NAMES, lacks, strict=True) if not lack & set(adequacy.BOTH)}
    beside = probes.beside_pole(0.1, THREE[-1], results.gains(), results.dt_s)
    return word_of(not both, all(lack & {"e", "h"} for lack in both.values())), evidence(
        f"""{"; ".join(_placed(one, known) for one in three)}. Adequate in both: {", ".join(both) or "none"}. Settling
        time of a small error: {linear:.3f} s. Not counted: feedback-linearized fails from
        {int((~settled(beside)).sum())} of {len(beside)} starts spinning at {probes.SPEED:g} rad/s beside a pole.""",
        len(THREE) + sum(one.rows for one in three),
        ("episodes", "costs", "timings") if known.times else ("episodes", "costs"),
    )


def _placed(one: Adequacy, known: Ledger) -> str:
    return (
        f"{one.name.partition('/')[0]} {one.settled:.2%} settled, {one.lost} ({one.lost_exact}) lost, of spinning ones "
        f"{'; '.join(map(tables.lost_text, one.spun[-1:])) or 'none is known'}, {adequacy.NEARLY_ALL:.0%} in "
        f"{one.pace.value:.2f} s ({one.pace.low:.2f} to {one.pace.high:.2f}), {one.cost} flops and calls, "
        f"time {known.over(one.name, THREE[0])}"
    )


@claim("C27")
@on_every_engine
def c27(results: Results, engine: str) -> tuple[Word, Evidence]:
    """Each later law against the eight tests."""
    later = [one for one in adequacy.every(results, engine) if one.name not in PAPERS]
    held = adequacy.held(results, adequacy.HELD_RAD)
    some([one for one in later if one.name in held], f"later law by {engine} on which noise was tried")
    known, small = adequacy.of_three(results), closed_form.linear_settling(*results.gains())
    if not known.times:
        raise NoEvidence("no law was timed, and flops and calls alone give no cost: run bench time")
    lacks = {one.name: adequacy.missed(one, known, small, held) for one in later}
    adequate = [one.name for one in later if not set(lacks[one.name]) & set(adequacy.BOTH)]
    answers = [
        f"{one.name} (time {known.over(one.name, THREE[0])}, {one.cost} flops and calls, {one.settled:.2%} of {one.n} "
        f"starts settle, {adequacy.NEARLY_ALL:.0%} in {one.pace.value:.2f} s, way at most {one.detour:.2f} times the "
        "shortest)"
        for one in later
        if not lacks[one.name]
    ]
    lacking = "; ".join(f"{name} ({', '.join(missed)})" for name, missed in lacks.items() if missed) or "nothing"
    untimed = [one.name for one in later if not any(one.name in times for times in known.times)]
    return Word.ANSWERED if answers else Word.HOLDS, evidence(
        f"""Of {len(later)} later laws adequate in both cost and performance: {", ".join(adequate) or "none"}. All eight
        tests: {"; ".join(answers) or "none"}. What each other lacks: {lacking}. The paper's laws on angles take
        {" and ".join(known.over(name, THREE[0]) for name in THREE[1:])} times the rotation matrix's time; not timed,
        so that operations decide: {", ".join(untimed) or "none"}. In these times a call takes {known.price:.0f} flops.
        A small error settles in {small:.3f} s, and {adequacy.SLOW * small:.3f} s is the slowest that is adequate.""",
        sum(one.rows + held.get(one.name, (0, 0))[1] for one in later),
    )


def _of_the_three(results: Results) -> list[pd.DataFrame]:
    """Uniform starts from rest of each law, the same in the same order; one that does not converge settles nowhere."""
    found = [results.episodes(name, MAIN_ENGINE, "uniform") for name in NAMES]
    found = [one.assign(outcome=one["outcome"].astype(str).where(one["converged"] != "no", "unknown")) for one in found]
    return tables.same_starts(found)


@claim("C31")
@at_every_gain
def c31(results: Results) -> tuple[Word, Evidence]:
    """Shares that settle, and ratios of the time in which nearly all do."""
    laws = _of_the_three(results)
    matrix, linearized, mine = ranges = [share(settled(one)) for one in laws]
    ratios = [_gain(settling_times(laws[-1]), settling_times(one)) for one in laws[:-1]]
    is_better = all(ratio.low >= LIMIT.DRAMATIC for ratio in ratios) and mine.low > linearized.high
    told = ", ".join(f"{name} {one}" for name, one in zip(NAMES, ranges, strict=True))
    sooner = ", ".join(f"{name} {interval(ratio, '.2f')}" for name, ratio in zip(NAMES, ratios, strict=False))
    return word_of(is_better and mine.low > matrix.high, is_better and mine.high >= matrix.low), evidence(
        f"""Settled: {told}. Time in which {LIMIT.NEARLY_ALL:.0%} settle over that of feedback linearization:
        {sooner}.""",
        3 * len(laws[-1]),
    )


def _gain(own: np.ndarray, other: np.ndarray) -> Any:
    """Return the other's time in which nearly all settle over its own; resampled by starts."""

    def ratio(drawn: np.ndarray, axis: Sequence[float] | np.ndarray) -> Any:
        quantiles = quantile(drawn, LIMIT.NEARLY_ALL, axis=-2)
        with np.errstate(invalid="ignore"):
            ratios = quantiles[..., 1] / quantiles[..., 0]
        return np.where(np.isnan(ratios), 1.0, ratios)  # neither settles

    return bootstrap(np.stack([own, other], axis=1), ratio)


@claim("C35")
def c35(results: Results) -> tuple[Word, Evidence]:
    """Shares and medians of the three."""
    small, laws = closed_form.linear_settling(*results.gains()), _of_the_three(results)
    found = [
        (name, share(settled(rows)), quantile_estimate(settling_times(rows), 0.5))
        for name, rows in zip(NAMES, laws, strict=True)
    ]
    reasonable = [name for name, one, time in found if one.low >= LIMIT.REASONABLE and time.high <= LIMIT.PACE * small]
    told = "; ".join(
        f"{name} {one}, in {time.value:.3f} s ({time.low:.3f} to {time.high:.3f}) in the median"
        for name, one, time in found
    )
    return word_of(len(reasonable) == 2, len(reasonable) == 3), evidence(
        f"""Reasonable: {", ".join(reasonable) or "none"}. {told}. A small error settles in {small:.3f} s.""",
        sum(one.n for _, one, _ in found),
    )


@claim("C36")
def c36(results: Results) -> tuple[Word, Evidence]:
    """Return which tests of performance each of the three lacks, exact boundary points included."""
    small, known = closed_form.linear_settling(*results.gains()), adequacy.of_three(results)
    three = some([one for one in adequacy.every(results, MAIN_ENGINE) if one.name in THREE], "law of the paper")
    lacks = {one.name: set(adequacy.missed(one, known, small, {})) & set(LIMIT.TESTS) for one in three}
    told = "; ".join(
        f"{one.name.partition('/')[0]} lacks {', '.join(sorted(lacks[one.name])) or 'nothing'} ({one.settled:.2%} of "
        f"{one.n:,} settle, {one.lost} of {one.directed} directed starts are lost, {one.lost_exact} on a boundary "
        f"itself, 99% settle in {one.pace.value:.2f} s)"
        for one in three
    )
    is_none = len(three) == len(THREE) and all(lacks.values())
    return word_of(is_none, False), evidence(f"{told}.", sum(one.rows for one in three))
