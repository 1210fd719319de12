"""C12 and C17: cost of calculation, and cost against performance (Murphy 1988, 2.5 and 4)."""

import itertools

import numpy as np

from bench.findings.claims import adequacy, probes, standing
from bench.findings.claims.adequacy import DIRECTED_SHARE, NEARLY_ALL, SETTLED_SHARE, SLOW, THREE
from bench.findings.claims.at_gains import RULE, at_every_gain
from bench.findings.claims.standing import ORDERED, Ledger
from bench.findings.claims.tables import evidence, lost_text, on_every_engine, settled
from bench.findings.claims.verdict import Earlier, NoEvidence, Word, claim, word_of
from bench.findings.theory import closed_form

LITERAL = "feedback-linearized-literal/zyx-euler"


@claim(
    id="C12",
    section="2.5",
    quote="""
        The regulator was remarkably simple to calculate ... the calculations involved are more involved than
        for the previous regulator ... This regulator had the highest calculation requirements.
    """,
    value="an order",
    written="2026-11-23 953f62a",
    sentence="Cost rises from the rotation-matrix law over the linearized to the feedback-linearized law.",
    question="Do time and operations per tick come in that order?",
    criterion=f"""
        Both pairs of neighbours, law alone: time a tick, and flops and calls of costs.parquet, typical branch, without
        the stage 'goal' (the paper's accounting, for it gives E_d in Euler angles) and with it. {standing.RULE} It
        holds if both pairs are in order; with a correction if a pair that is not is disputed: in order by time and
        reversed by columns, or the other way round; otherwise it does not hold. Reported: the order by flops alone.
    """,
    open="The paper gives no numbers at all, only an order, and does not say whether of time or of operations.",
    readings=(
        "the goal is given in the law's own coordinates (the paper's accounting)",
        "the goal is a rotation matrix",
    ),
    correction="By time and by operations the laws come in different orders.",
    earlier=(
        Earlier(
            "2026-11-21 9072535",
            """
            A call counted as 10 flops at most; that the columns differ made a correction, which is one of our price,
            not of the paper.
            """,
            Word.CORRECTED,
        ),
    ),
)
def c12(results):
    """Neighbours by time, and by flops and calls in both accountings."""
    known = adequacy.of_three(results)
    pairs = [known.stand(*pair) for pair in itertools.pairwise(THREE)]
    if not all(one.sign for one in pairs):
        raise NoEvidence("flops and calls say different things, and no time decides: run python -m bench time")
    in_order = [one.sign == ORDERED and not one.is_disputed for one in pairs]
    word = word_of(all(in_order), all(np.logical_or(in_order, [one.is_disputed for one in pairs])))
    paper, total = (", ".join(f"{_law(name)} {one[name]}" for name in THREE) for one in known.accountings)
    return word, evidence(
        f"""Time a tick over the rotation matrix's: {_timed(known)}; its intervals part
        {sum(bool(one.by_time) for one in pairs)} of {len(pairs)} pairs. Flops and calls: {paper}; with the goal's
        angles taken from its matrix: {total}; the columns decide {sum(0 not in one.by_columns for one in pairs)} of
        {len(pairs)} pairs{_priced(known)}. {_flops_alone(known)}{_as_printed(known)}""",
        len(THREE) * (len(known.accountings) + len(known.times)),
        ("costs", "timings") if known.times else ("costs",),
    )


def _as_printed(known: Ledger) -> str:
    """What (2.15) takes term by term; the law that is compared shares sines and folds Bdot into few operations."""
    literal = known.accountings[0].get(LITERAL)
    return f" (2.15) as printed, term by term, takes {literal}." if literal else ""


def _timed(known: Ledger) -> str:
    """'linearized-euler 10.0, feedback-linearized 10.3', or that they were not timed."""
    return ", ".join(f"{_law(name)} {known.over(name, THREE[0])}" for name in THREE[1:])


def _priced(known: Ledger) -> str:
    """The price of a call, if the times know one."""
    return f"; in these times a call takes {known.price:.0f} flops" if np.isfinite(known.price) else ""


def _flops_alone(known: Ledger) -> str:
    """Where flops, calls left out, come in another order."""
    orders = [[name for _, name in sorted((one[name].flops, name) for name in THREE)] for one in known.accountings]
    others = [" < ".join(map(_law, order)) for order in orders if tuple(order) != THREE]
    return f"By flops alone, calls left out: {'; '.join(others) or 'the same order'}."


@claim(
    id="C17",
    section="2.5, 4",
    quote="Overall, no regulator performed adequately in terms of both calculation cost and performance.",
    written="2026-11-24 c7944ec",
    sentence="No regulator performs adequately in both calculation cost and performance.",
    question="Which of the three is adequate in which, on one plane of cost and performance?",
    criterion=f"""
        Adequate performance: (a) at least {SETTLED_SHARE:.1%} of the uniform starts settle; (b) so do at
        least {DIRECTED_SHARE:.0%} of the directed starts at rest (half-turn, poles, wraps, box, goals) that
        are not themselves on a 180° rotation, a pole or a wrap to 1e-13 rad, nor their goals on a pole, and of
        random starts that spin, at each speed of results/maps, all but a share whose exact 95 % interval
        ends at {1 - SETTLED_SHARE:.1%} or below, those that do not converge counted as lost; (c)
        {NEARLY_ALL:.0%} of the uniform starts settle within {SLOW:g} times the settling time of a small error, by the
        upper end of the 95 % interval of that quantile. Adequate cost: (d) the law costs less than each other law on
        Euler angles, whose cost is what the paper objects to (2.5), as C12 compares them. It
        holds if none of rotation-matrix, linearized-euler and feedback-linearized is adequate in both; with a
        correction if one is, but fails on starts that (b) leaves out, or is cheaper by time and not by operations;
        otherwise it does not hold. {RULE} Later laws do not change this verdict, they answer C27.
    """,
    open=f"""
        'Adequate' is the paper's word without a number: the word rests on the thresholds of (a) to (c), which are ours,
        and on the gains, of which the paper gives none for the first law. (c) is what the paper calls uncertain
        settling times. Random starts that spin are those of results/maps, at its gains, whatever the run's. Cost is
        that of the law alone, and its times were known when (d) was written. Of a whole controller's tick the laws
        differ by so little that our advice does not tell them apart (up to {100 * standing.MEASURABLE:.0f} % counts as
        equal there): by that measure the objection to cost is empty.
    """,
    instead="""
        At the gains of the other laws no regulator is adequate in both; at the lowest damping tried the rotation-matrix
        law is, isolated orientations aside.
    """,
    correction="One of the three is adequate in both, but for isolated orientations, or by one measure of cost alone.",
    earlier=(
        Earlier(
            "2026-11-21 9072535",
            """
            Adequate cost was twice the cheapest at most, a call counted as 10 flops (1 to 20 tried): of two numbers of
            ours the first let the feedback-linearized law in, which takes ten times the time. (b) asked that every
            directed start settle, 200 tumbling ones among them: whether one of these is lost depends on the draw.
            """,
            Word.CORRECTED,
        ),
        Earlier(
            "2026-11-23 953f62a",
            """
            (d) compared each law on Euler angles with itself too, so that neither could pass; (c) was of the slowest
            start, which grows with the number of starts. It was decided at one pair of gains.
            """,
            Word.HOLDS,
        ),
    ),
)
@at_every_gain
@on_every_engine
def c17(results, engine):
    """The three laws against the three tests of performance and the test of cost."""
    linear = closed_form.linear_settling(*results.gains())
    three = [one for one in adequacy.every(results, engine) if one.name in THREE]
    if len(three) < len(THREE):
        raise NoEvidence(f"not all of {', '.join(THREE)} ran by {engine}: run a suite without narrowing it")
    known = adequacy.of_three(results)
    lacks = {one.name: set(adequacy.missed(one, known, linear, {})) for one in three}
    both = [one.name for one in three if not lacks[one.name] & set(adequacy.BOTH)]
    word = word_of(not both, all(lacks[name] & {"e", "h"} for name in both))
    beside = probes.beside_pole(0.1, THREE[-1], results.gains(), results.dt_s)
    laws = "; ".join(_placed(one, known) for one in sorted(three, key=lambda one: THREE.index(one.name)))
    adequate = ", ".join(_law(name) for name in THREE if name in both) or "none"
    return word, evidence(
        f"""{laws}. Adequate in both: {adequate}. Settling time of a small error: {linear:.3f} s. Not counted:
        feedback-linearized fails from {int((~settled(beside)).sum())} of {len(beside)} starts spinning at
        {probes.SPEED:g} rad/s beside a pole.""",
        len(THREE) + sum(one.rows for one in three),
        ("episodes", "costs", "timings") if known.times else ("episodes", "costs"),
    )


def _law(name: str) -> str:
    return name.partition("/")[0]


def _placed(one: adequacy.Adequacy, known: Ledger) -> str:
    pace = f"{NEARLY_ALL:.0%} in {one.pace.value:.2f} s ({one.pace.low:.2f} to {one.pace.high:.2f})"
    return (
        f"{_law(one.name)} {one.settled:.2%} settled, {one.lost} ({one.lost_exact}) lost, of spinning ones "
        f"{'; '.join(map(lost_text, one.spun[-1:])) or 'none is known'}, {pace}, {one.cost} flops and calls, "
        f"time {known.over(one.name, THREE[0])}"
    )
