"""C12, C17, C27, C31, C35, C36: cost and performance of the paper's laws and later ones (Murphy 1988, 2.5 and 4)."""

from __future__ import annotations

import itertools
from collections import Counter

import numpy as np

from bench.base.errors import NoEvidence
from bench.base.on_first_use import pd
from bench.experiments.probe_values.turns import SPEED
from bench.experiments.tables.run import MAIN_ENGINE, Run, require_rows
from bench.experiments.tables.statistics import (
    Estimate,
    percentile_estimate,
    quantile,
    quantile_estimate,
    resampled_quantile,
)
from bench.findings.amounts import capitalize, count_of, join_words, part_of
from bench.findings.claims import adequacy, tables
from bench.findings.claims.adequacy import PAPERS, THREE, Adequacy, is_without_memory, whose
from bench.findings.claims.at_gains import at_every_gain, on_every_engine
from bench.findings.claims.standing import ORDERED, Ledger
from bench.findings.claims.tables import episodes_of, evidence, percent, settled, share
from bench.findings.claims.verdict import Evidence, Word, claim, word_of
from bench.findings.theory import closed_form
from bench.law.attribution import ADAPTED, OURS, PUBLISHED

LITERAL = "feedback-linearized-literal/zyx-euler"
# The quantile that stands for 'the range', and the factor in time from which an improvement is dramatic.
NEARLY_ALL = 0.99
DRAMATIC = 2.0
# Share that settles, and the factor over the time of a small error, in the median: from there on it is reasonable.
REASONABLE = 0.99
PACE = 2.0
# Tests of C27 that are of performance: shares that settle, times, and starts on a boundary itself.
TESTS = "abce"


BESIDE_RAD = 0.1
"""Margin of the probe `beside-pole` outside which bodies spin."""

NAMES = [name.partition("/")[0] for name in THREE]
IN_WORDS = ["the rotation-matrix law", "the linearized law", "feedback linearization"]
"""What the three laws are called in sentences."""


@claim("C12")
def c12(run: Run) -> tuple[Word, Evidence]:
    """Compare neighbours by time, and by flops and calls of costs.parquet, with those of the stage goal and without."""
    known = adequacy.of_three(run)
    pairs = [known.stand(*pair) for pair in itertools.pairwise(THREE)]
    if not all(one.sign for one in pairs):
        raise NoEvidence("flops and calls say different things, and no time decides: run bench time")
    in_order = [one.sign == ORDERED and not one.is_disputed for one in pairs]
    paper, total = (
        "; ".join(f"{one[name]} for {law}" for law, name in zip(IN_WORDS, THREE, strict=True))
        for one in known.accountings
    )
    own = [known.accountings[0][name] for name in THREE]
    times = [known.over(name, THREE[0]) for name in THREE[1:]]
    ratios = "Their times were not measured."
    if known.times:
        ratios = f"The last two laws take {join_words(times)} times as long as the rotation-matrix law."
    in_words = [law.removeprefix("the ") for law in IN_WORDS]
    timed = " and ".join(f"{ratio} for {law}" for law, ratio in zip(IN_WORDS[1:], times, strict=True))
    orders = [
        [law for _, law in sorted((one[name].flops, law) for law, name in zip(in_words, THREE, strict=True))]
        for one in known.accountings
    ]
    others = [", ".join(order) for order in orders if order != in_words]
    by_flops = "; ".join(others) or "the same"
    literal = known.accountings[0].get(LITERAL)  # the law that is compared shares sines and folds Bdot
    as_printed = ""
    if literal:
        as_printed = (
            "If equation (2.15) is computed term by term, as the paper prints it, it takes "
            f"{literal.flops} flops and {literal.calls} calls."
        )
    priced = ""
    if np.isfinite(known.price):
        priced = f" By the measured times, a call takes as long as {known.price:.0f} flops."
    timed_pairs = sum(bool(pair.by_time) for pair in pairs)
    is_ordered = all(pair.sign == ORDERED for pair in pairs)
    by_one_measure = timed_pairs == len(pairs) and not others and all(in_order)
    ordered: dict[str, list[str]] = {"measured times": [], "counted operations": []}
    for pair, neighbours in zip(pairs, itertools.pairwise(IN_WORDS), strict=True):
        ordered["measured times" if pair.by_time else "counted operations"].append(" and ".join(neighbours))
    parts = {what: ", and of ".join(each) for what, each in ordered.items() if each}
    decided = " ".join(f"The {what} decide the order of {laws}." for what, laws in parts.items())
    instead = f"""The paper's order is right if times and operations are used together. {decided} By flops alone, the
    order is (the cheapest law first): {by_flops}."""
    word = word_of(by_one_measure, is_ordered or all(np.logical_or(in_order, [pair.is_disputed for pair in pairs])))
    return word, evidence(
        f"""The computing times per control period, divided by the time of the rotation-matrix law, are {timed}. The
        paper's order has two pairs of neighbouring laws. In {count_of(timed_pairs, len(pairs), "pairs")}, the 95 %
        intervals of the two times do not overlap. The numbers of flops and of calls (of sin, cos, atan2 or acos) are:
        {paper}. If a law on Euler angles also computes the goal's angles from the goal's rotation matrix, the numbers
        are: {total}. In {count_of(sum(0 not in pair.by_columns for pair in pairs), len(pairs), "pairs")}, flops and
        calls give the same order.{priced} By flops alone, the order is (the cheapest law first): {by_flops}.
        {as_printed}""",
        len(THREE) * (len(known.accountings) + len(known.times)),
        ("costs", "timings") if known.times else ("costs",),
        instead if word == Word.CORRECTED else "",
        f"""The numbers of flops and of calls are {own[0]} for the rotation-matrix law, {own[1]} for the linearized law
        and {own[2]} for feedback linearization. {ratios}""",
    )


@claim("C17")
@at_every_gain
@on_every_engine
def c17(run: Run, engine: str) -> tuple[Word, Evidence]:
    """Return the three laws against the three tests of performance and the test of cost."""
    linear = closed_form.linear_settling(*run.gains())
    by_name = {law.name: law for law in adequacy.every(run, engine, THREE)}
    if not set(THREE) <= set(by_name):
        raise NoEvidence(f"not all of {', '.join(THREE)} ran by {engine}: run a suite without narrowing it")
    three = [by_name[name] for name in THREE]
    known = adequacy.of_three(run)
    every = {name: adequacy.examine(law, known, linear, {}) for name, law in zip(NAMES, three, strict=True)}
    asked = {name: tested.among(adequacy.BOTH) for name, tested in every.items()}
    adequate = [name for name, tested in asked.items() if tested.passes]
    open_yet = [name for name, tested in asked.items() if tested.may_pass]
    is_isolated = all(every[name].failed & {"e", "h"} for name in adequate)
    word = word_of(not adequate, is_isolated)
    if open_yet and word != Word.FAILS:
        word = Word.UNTESTED
    words = [law for law, name in zip(IN_WORDS, NAMES, strict=True) if name in adequate]
    fine = "None of the three laws is"
    if words:
        fine = f"{capitalize(join_words(words))} {'is' if len(words) == 1 else 'are'}"
    if adequate:
        beside_it = "".join(
            said
            for test, said in BESIDE.items()
            if is_isolated and any(test in every[name].failed for name in adequate)
        )
        instead = f"{fine} adequate in both cost and performance.{beside_it}"
    else:
        instead = "None of the three laws is adequate in both cost and performance."
    if open_yet:
        lacking = "; ".join(f"{name} ({asked[name]})" for name in open_yet)
        instead = f"Whether a law is adequate in both cost and performance is not tested: {lacking}."
    within = "fewer than 99 % of uniform starts settle"
    if np.isfinite(three[0].pace.value):
        within = f"99 % of uniform starts settle within {tables.named_interval(three[0].pace, '.2f', ' s')}"
    spins = run.probe("beside-pole")
    beside = require_rows(spins[spins["at"] == BESIDE_RAD], "spin beside a pole")
    return word, evidence(
        f"""{fine} adequate in both cost and performance. The settling time of a small error is {linear:.3f} s. Starts
        that spin at {SPEED:g} rad/s near a pole do not count for the verdict. Feedback linearization settles
        from {count_of(int(settled(beside).sum()), len(beside), "starts of this kind")}.""",
        len(THREE) + sum(law.rows for law in three),
        ("episodes", "costs", "timings") if known.times else ("episodes", "costs"),
        instead,
        f"{fine} adequate in both respects. With the rotation-matrix law, {within}.",
        (PLACES, *(_placed(law, asked[name], known) for name, law in zip(NAMES, three, strict=True))),
    )


BESIDE = {
    "e": " But it does not settle from some starts exactly on a boundary (180°, a pole, or an angle of ±π).",
    "h": " But its cost is lower than that of the laws on Euler angles only by time, not by counted operations.",
}
"""What an adequate law may fail: tests of C27 that C17 leaves out."""

PLACES = (
    "Law",
    "Tests (a) to (d)",
    "Uniform starts that settle",
    "Difficult starts that do not settle",
    "Starts exactly on a boundary that do not settle",
    "Spinning starts that do not settle (95 % interval in brackets)",
    "Time until 99 % of the uniform starts settle (95 % interval in brackets)",
    "Flops and calls",
    "Computing time, divided by that of the rotation-matrix law",
)
"""Heads of what was measured of a law."""


def _placed(law: Adequacy, tested: adequacy.Tested, known: Ledger) -> tuple[str, ...]:
    """Return what was measured of a law, by the heads of PLACES."""
    spun = "; ".join(map(tables.lost_text, law.spun[-1:])) or "not tested"
    return (
        law.name,
        tested.in_words(),
        f"{percent(law.settled)} %",
        part_of(law.lost, law.directed),
        part_of(law.lost_exact, law.exact),
        spun,
        tables.interval_or_never(law.pace, ".2f", " s"),
        str(law.cost),
        known.over(law.name, THREE[0]),
    )


@claim("C27")
@on_every_engine
def c27(run: Run, engine: str) -> tuple[Word, Evidence]:
    """Each later law against the eight tests."""
    later = [one for one in adequacy.every(run, engine) if one.name not in PAPERS]
    held = adequacy.held(run, adequacy.HELD_RAD)
    require_rows([one for one in later if one.name in held], f"later law by {engine} on which noise was tried")
    known, small = adequacy.of_three(run), closed_form.linear_settling(*run.gains())
    if not known.times:
        raise NoEvidence("no law was timed, and flops and calls alone give no cost: run bench time")
    tested = {law.name: adequacy.examine(law, known, small, held) for law in later}
    adequate = [name for name, result in tested.items() if result.among(adequacy.BOTH).passes]
    answers = [law for law in later if tested[law.name].passes]
    others = [law for law in later if not tested[law.name].passes]
    told = [f"{law.name} ({whose(law.name)})" for law in answers]
    untimed = [law.name for law in later if not any(law.name in times for times in known.times)]
    counts = Counter(whose(law.name) for law in later)
    by_others = counts[PUBLISHED] + counts[ADAPTED]
    word = Word.HOLDS
    if answers:
        word = Word.ANSWERED
    elif any(result.may_pass for result in tested.values()):
        word = Word.UNTESTED
    named = "; ".join(told)
    without = [result for name, result in tested.items() if is_without_memory(name) and not result.may_pass]
    passing = sum(result.passes for result in without)
    rest = "Laws without memory were not tested."
    if without:
        rest = f"Of the {len(without)} later laws without memory, {passing or 'none'} pass all eight tests."
    # (e) and (f) together are impossible without memory: Bhat and Bernstein 2000; Mayhew, Sanfelice, Teel 2011.
    impossible = ""
    if without and not passing:
        impossible = " A law without memory cannot pass all eight tests."
    instead = ""
    if answers:
        instead = f"These laws pass all eight tests and so answer the open question: {named}.{impossible}"
    return word, evidence(
        f"""We tested {by_others} later laws by others, of which we adapted {counts[ADAPTED]}, and {counts[OURS]}
        later laws of ours. {capitalize(count_of(len(adequate), len(later), "later laws"))} are adequate in both
        cost and performance, that is, they pass tests (a) to (d). These laws pass all eight tests:
        {", ".join(told) or "none"}. The paper's laws on Euler angles take
        {" and ".join(known.over(name, THREE[0]) for name in THREE[1:])} times as long as the rotation-matrix law.
        For laws that were not timed, operations decide: {", ".join(untimed) or "none"}. By the measured times, a
        call takes as long as {known.price:.0f} flops. A small error settles in {small:.3f} s, and the longest
        adequate settling time is {adequacy.SLOW * small:.3f} s.""",
        sum(law.rows + held.get(law.name, (0, 0))[1] for law in later),
        instead=instead,
        measured=f"""{capitalize(count_of(len(answers), len(later), "later laws"))} (all laws except
        the paper's) pass all eight tests of our criterion. {rest}""",
        numbers=(ANSWERS, *(_answer(law, tested[law.name], known) for law in (*answers, *others))),
    )


ANSWERS = (
    "Law",
    "Attribution",
    "Tests (a) to (h)",
    "Flops and calls",
    "Computing time, divided by that of the rotation-matrix law",
    "Uniform starts that settle",
    "Time until 99 % of the uniform starts settle (95 % interval in brackets)",
    "Length of the path, divided by that of the shortest path (greatest value)",
)
"""Heads of what was measured of a later law."""


def _answer(law: Adequacy, tested: adequacy.Tested, known: Ledger) -> tuple[str, ...]:
    """Return what was measured of a later law, by the heads of ANSWERS."""
    return (
        law.name,
        whose(law.name),
        tested.in_words(),
        str(law.cost),
        known.over(law.name, THREE[0]),
        f"{percent(law.settled)} %",
        tables.interval_or_never(law.pace, ".2f", " s"),
        f"{law.detour:.2f}" if np.isfinite(law.detour) else "not tested",
    )


def _of_the_three(run: Run) -> list[pd.DataFrame]:
    """Return the uniform starts that all laws ran; unconverged episodes count as unsettled."""
    found = [episodes_of(run, name, MAIN_ENGINE, "uniform") for name in NAMES]
    found = [one.assign(outcome=one["outcome"].astype(str).where(one["converged"] != "no", "unknown")) for one in found]
    return tables.same_starts(found)


@claim("C31")
@at_every_gain
def c31(run: Run) -> tuple[Word, Evidence]:
    """Shares that settle, and ratios of the time in which nearly all do."""
    laws = _of_the_three(run)
    matrix, linearized, mine = ranges = [share(settled(one)) for one in laws]
    ratios = [_gain(tables.settling_times(laws[-1]), tables.settling_times(one)) for one in laws[:-1]]
    is_better = all(ratio.low >= DRAMATIC for ratio in ratios) and mine.low > linearized.high
    longer = [tables.interval_or_never(ratio, ".2f") for ratio in ratios]
    by_matrix = tables.named_interval(ratios[0], ".2f")
    settles = [tables.brief_interval(one) for one in ranges]
    return word_of(is_better and mine.low > matrix.high, is_better and mine.high >= matrix.low), evidence(
        f"""Of {matrix.n:,} uniform starts, {percent(matrix.value)} % settle with the rotation-matrix law,
        {percent(linearized.value)} % with the linearized law, and {percent(mine.value)} % with feedback
        linearization.""",
        3 * len(laws[-1]),
        instead=f"""The time until {100 * NEARLY_ALL:.0f} % of the starts settle is {by_matrix} times as long
        with the rotation-matrix law as with feedback linearization. The rotation-matrix law settles from
        {count_of(matrix.k, matrix.n, "starts")}.""",
        measured=f"""The time until 99 % of the starts settle is {by_matrix} times as long with the rotation-matrix
        law as with feedback linearization.""",
        numbers=(
            (
                "Law",
                "Uniform starts that settle (95 % interval in brackets)",
                "Time until 99 % of the starts settle, divided by this time with feedback linearization "
                "(95 % interval in brackets)",
            ),
            *zip(THREE, settles, (*longer, "1"), strict=True),
        ),
    )


def feedback_gain(run: Run) -> Estimate:
    """Return how many times as long 99 % of the starts take with the rotation-matrix law, at the run's gains."""
    matrix, _, feedback = _of_the_three(run)
    return _gain(tables.settling_times(feedback), tables.settling_times(matrix))


def _gain(own: np.ndarray, other: np.ndarray) -> Estimate:
    """Return the other's time in which nearly all settle over its own; resampled by starts."""
    quantiles = np.array([quantile(times, NEARLY_ALL) for times in (own, other)])
    resampled = np.stack([resampled_quantile(times, NEARLY_ALL) for times in (own, other)])
    return percentile_estimate(_ratio(*quantiles), _ratio(*resampled))


def _ratio(own: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Return other / own, 1 where neither settles: both are infinite there."""
    with np.errstate(invalid="ignore"):
        ratios = other / own
    return np.where(np.isnan(ratios), 1.0, ratios)


@claim("C35")
def c35(run: Run) -> tuple[Word, Evidence]:
    """Shares and medians of the three."""
    small, laws = closed_form.linear_settling(*run.gains()), _of_the_three(run)
    found = [
        (law, share(settled(rows)), quantile_estimate(tables.settling_times(rows), 0.5))
        for law, rows in zip(IN_WORDS, laws, strict=True)
    ]
    matrix, linearized, feedback = (one for _, one, _ in found)
    reasonable = [law for law, one, time in found if one.low >= REASONABLE and time.high <= PACE * small]
    told = " ".join(
        f"With {law}, {one} of the starts settle. The median settling time is "
        f"{tables.interval_or_never(time, '.3f', ' s')}."
        for law, one, time in found
    )
    return word_of(len(reasonable) == 2, len(reasonable) == 3), evidence(
        f"""These laws perform reasonably: {join_words(reasonable) or "none"}. {told} The settling time of a small error
        is {small:.3f} s. The brackets give 95 % intervals and the number n of starts.""",
        sum(one.n for _, one, _ in found),
        measured=f"""Of {matrix.n:,} uniform random starts, {percent(matrix.value)} % settle with the
        rotation-matrix law, {tables.percent_interval(linearized)} with the linearized law, and
        {percent(feedback.value)} % with feedback linearization.""",
    )


@claim("C36")
def c36(run: Run) -> tuple[Word, Evidence]:
    """Return which tests of performance each of the three lacks, exact boundary points included."""
    small, known = closed_form.linear_settling(*run.gains()), adequacy.of_three(run)
    three = require_rows(adequacy.every(run, MAIN_ENGINE, THREE), "law of the paper")
    tested = {law.name: adequacy.examine(law, known, small, {}).among(TESTS) for law in three}
    in_words = dict(zip(THREE, IN_WORDS, strict=True))
    told = " ".join(
        f"{capitalize(in_words[one.name])} {tested[one.name].in_words().replace('fails ', 'fails these tests: ')}. "
        f"With this law, {percent(one.settled)} % of {one.n:,} uniform starts settle. {_paced(one)} "
        f"{capitalize(part_of(one.lost, one.directed))} difficult starts and "
        f"{part_of(one.lost_exact, one.exact)} starts exactly on a boundary are lost."
        for one in three
    )
    word = word_of(len(three) == len(THREE) and all(result.failed for result in tested.values()), False)
    if word == Word.FAILS and not any(result.passes for result in tested.values()):
        word = Word.UNTESTED
    by_name = {law.name: law for law in three}
    on_boundary = join_words([
        f"{part_of(by_name[name].lost_exact, by_name[name].exact)}{' do not settle' * (law == IN_WORDS[0])} with {law}"
        for law, name in zip(IN_WORDS, THREE, strict=True)
        if name in by_name
    ])
    return word, evidence(
        f"{told} The brackets after a time give its 95 % interval.",
        sum(law.rows for law in three),
        measured=f"""Some starts are exactly on a boundary (a 180° rotation, a pole or an angle of ±π). Of these,
        {on_boundary}.""",
    )


def _paced(law: Adequacy) -> str:
    """Return the time within which nearly all uniform starts settle, in a sentence."""
    if not np.isfinite(law.pace.value):
        return "Fewer than 99 % of the uniform starts settle."
    return f"99 % of the uniform starts settle within {tables.interval_or_never(law.pace, '.2f', ' s')}."
