"""C12, C17, C27, C31, C35, C36: cost and performance of the paper's laws and later ones (Murphy 1988, 2.5 and 4)."""

from __future__ import annotations

import itertools
from collections import Counter
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
from bench.law.contenders.registry import all_contenders

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
    timed_pairs = sum(bool(pair.by_time) for pair in pairs)
    is_ordered = all(pair.sign == ORDERED for pair in pairs)
    by_one_measure = timed_pairs == len(pairs) and not others and all(in_order)
    parted = [
        f"{short} from {other}"
        for pair, (short, other) in zip(pairs, itertools.pairwise(NAMES), strict=True)
        if pair.by_time
    ]
    instead = f"""The order is that of time and operations together. Time parts {" and ".join(parted) or "no two laws"};
        operations decide the rest. By flops alone, calls left out: {"; ".join(others) or "the same order"}."""
    word = word_of(by_one_measure, is_ordered or all(np.logical_or(in_order, [pair.is_disputed for pair in pairs])))
    return word, evidence(
        f"""Time a tick over the rotation matrix's: {timed}; its intervals part {timed_pairs} of {len(pairs)} pairs.
        Flops and calls: {paper}; with the goal's angles taken from its matrix: {total}; the columns decide
        {sum(0 not in pair.by_columns for pair in pairs)} of {len(pairs)} pairs{priced}. By flops alone, calls left out:
        {"; ".join(others) or "the same order"}. {as_printed}""",
        len(THREE) * (len(known.accountings) + len(known.times)),
        ("costs", "timings") if known.times else ("costs",),
        instead if word == Word.CORRECTED else "",
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
    every = {name: adequacy.examine(law, known, linear, {}) for name, law in zip(NAMES, three, strict=True)}
    asked = {name: tested.among(adequacy.BOTH) for name, tested in every.items()}
    adequate = [name for name, tested in asked.items() if tested.passes]
    open_yet = [name for name, tested in asked.items() if tested.may_pass]
    is_isolated = all(every[name].failed & {"e", "h"} for name in adequate)
    word = word_of(not adequate, is_isolated)
    if open_yet and word != Word.FAILS:
        word = Word.UNTESTED
    if adequate:
        beside_it = " but for isolated orientations, or by one measure of cost alone" if is_isolated else ""
        instead = f"{' and '.join(adequate)} is adequate in both{beside_it}."
    else:
        instead = "None of the three is adequate in both."
    if open_yet:
        lacking = "; ".join(f"{name} ({asked[name]})" for name in open_yet)
        instead = f"Whether one is adequate in both is not tested: {lacking}."
    beside = probes.beside_pole(0.1, THREE[-1], results.gains(), results.dt_s)
    return word, evidence(
        f"""{"; ".join(_placed(law, known) for law in three)}. Adequate in both: {", ".join(adequate) or "none"}.
        {"; ".join(f"{name}: {tested}" for name, tested in asked.items())}. Settling
        time of a small error: {linear:.3f} s. Not counted: feedback-linearized fails from
        {int((~settled(beside)).sum())} of {len(beside)} starts spinning at {probes.SPEED:g} rad/s beside a pole.""",
        len(THREE) + sum(law.rows for law in three),
        ("episodes", "costs", "timings") if known.times else ("episodes", "costs"),
        instead,
    )


def _placed(law: Adequacy, known: Ledger) -> str:
    """Return what was measured of a law, in a sentence."""
    spun = "; ".join(map(tables.lost_text, law.spun[-1:])) or "not tested"
    return (
        f"{law.name.partition('/')[0]} {law.settled:.2%} settled, {law.lost} of {law.directed} directed starts lost, "
        f"{law.lost_exact} of {law.exact} on a boundary itself, of spinning ones {spun}, {adequacy.NEARLY_ALL:.0%} in "
        f"{law.pace.value:.2f} s ({law.pace.low:.2f} to {law.pace.high:.2f}), {law.cost} flops and calls, "
        f"time {known.over(law.name, THREE[0])}"
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
    tested = {law.name: adequacy.examine(law, known, small, held) for law in later}
    adequate = [name for name, result in tested.items() if result.among(adequacy.BOTH).passes]
    answers = [law for law in later if tested[law.name].passes]
    told = [
        f"{law.name}, {whose(law.name)} (time {known.over(law.name, THREE[0])}, {law.cost} flops and calls, "
        f"{law.settled:.2%} of {law.n} starts settle, {adequacy.NEARLY_ALL:.0%} in {law.pace.value:.2f} s, way at most "
        f"{law.detour:.2f} times the shortest)"
        for law in answers
    ]
    others = [f"{name}, {whose(name)} ({result})" for name, result in tested.items() if not result.passes]
    untimed = [law.name for law in later if not any(law.name in times for times in known.times)]
    counts = Counter(whose(law.name) for law in later)
    by_others = counts[PUBLISHED] + counts[ADAPTED_HERE]
    word = Word.HOLDS
    if answers:
        word = Word.ANSWERED
    elif any(result.may_pass for result in tested.values()):
        word = Word.UNTESTED
    named = ", ".join(f"{law.name} ({whose(law.name)})" for law in answers)
    instead = f"These laws pass all eight tests: {named}." if answers else ""
    return word, evidence(
        f"""Of {by_others} later laws by others, {counts[ADAPTED_HERE]} of them adapted here, and {counts[OWN]} of ours,
        these are adequate in both cost and performance: {", ".join(adequate) or "none"}. All eight tests:
        {"; ".join(told) or "none"}. Each other: {"; ".join(others) or "none"}. The paper's laws on angles take
        {" and ".join(known.over(name, THREE[0]) for name in THREE[1:])} times the rotation matrix's time; not timed,
        so that operations decide: {", ".join(untimed) or "none"}. In these times a call takes {known.price:.0f} flops.
        A small error settles in {small:.3f} s, and {adequacy.SLOW * small:.3f} s is the slowest that is adequate.""",
        sum(law.rows + held.get(law.name, (0, 0))[1] for law in later),
        instead=instead,
    )


OWN, ADAPTED_HERE, PUBLISHED, USERS = "ours", "adapted", "published", "yours"


def whose(name: str) -> str:
    """Return whether a contender's law is published, adapted here from others' works, ours, or a user's own."""
    known = {one.name: one.regulator for one in all_contenders()}
    if name not in known:
        return USERS
    law = known[name]
    if attribution := getattr(law, "attribution", ""):
        return str(attribution)
    if law.is_ours():
        return OWN
    return ADAPTED_HERE if law.source.startswith("after ") else PUBLISHED


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
        instead=f"""With the rotation-matrix law, the time in which {LIMIT.NEARLY_ALL:.0%} of the starts settle is
        {interval(ratios[0], ".2f")} times as long; {matrix.k} of {matrix.n} starts settle, and {mine.k} with feedback
        linearization.""",
    )


def feedback_gain(results: Results) -> Any:
    """Return how many times as long 99 % of the starts take with the rotation-matrix law, at the run's gains."""
    matrix, _, feedback = _of_the_three(results)
    return _gain(settling_times(feedback), settling_times(matrix))


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
    tested = {law.name: adequacy.examine(law, known, small, {}).among(LIMIT.TESTS) for law in three}
    told = "; ".join(
        f"{one.name.partition('/')[0]} {tested[one.name]} ({one.settled:.2%} of "
        f"{one.n:,} settle, {one.lost} of {one.directed} directed starts are lost, {one.lost_exact} on a boundary "
        f"itself, 99% settle in {one.pace.value:.2f} s)"
        for one in three
    )
    word = word_of(len(three) == len(THREE) and all(result.failed for result in tested.values()), False)
    if word == Word.FAILS and not any(result.passes for result in tested.values()):
        word = Word.UNTESTED
    return word, evidence(f"{told}.", sum(law.rows for law in three))
