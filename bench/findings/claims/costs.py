"""C12 and C17: cost of calculation, and cost against performance (Murphy 1988, 2.5 and 4)."""

import itertools

import numpy as np

from bench.findings.claims import adequacy, probes
from bench.findings.claims.adequacy import CALL_PRICE, CALL_PRICES, DEAR, DIRECTED_SHARE, SETTLED_SHARE, SLOW, tallied
from bench.findings.claims.tables import evidence, lost_text, on_every_engine, settled, some
from bench.findings.claims.verdict import NoEvidence, claim, word_of
from bench.findings.theory import closed_form

LAWS = ("rotation-matrix", "linearized-euler", "feedback-linearized")
THREE = ("rotation-matrix", "linearized-euler/zyx-euler", "feedback-linearized/zyx-euler")
"""The same as contenders, in the paper's coordinates."""

AGREES, MIXED, CONTRADICTS = "agrees", "mixed", "contradicts"


def costs(results, law: str, with_goal: bool) -> tuple[int, int]:
    """Flops and transcendental calls a tick, typical branch."""
    return tallied(some(results.free_body("costs", regulator=law, branch="typical"), f"cost of {law}"), with_goal)


def compared(cheap: tuple, dear: tuple) -> tuple[str, float]:
    """How two neighbours stand, and from which price of a call on they are in the stated order (0: at any)."""
    flops, calls = dear[0] - cheap[0], dear[1] - cheap[1]
    if flops >= 0 and calls >= 0 and flops + calls > 0:
        return AGREES, 0.0
    if calls > 0:
        return MIXED, -flops / calls
    if flops > 0:
        return MIXED, np.inf  # fewer calls and more flops: in order below a price only
    return CONTRADICTS, np.inf


@claim(
    id="C12",
    section="2.5",
    sentence="Cost rises from the rotation-matrix law over the linearized to the feedback-linearized law.",
    question="Do operations per tick, and time per tick, come in that order?",
    criterion=f"""
        costs.parquet, typical branch, flops and transcendental calls (sin, cos, atan2, acos) in columns
        of their own. Paper's accounting: without the stage 'goal', for the paper gives E_d in Euler
        angles; total: with it. A pair of neighbours agrees if the dearer has no fewer flops and no fewer
        calls, and more of one; it is mixed if one column says so and the other not. A mixed pair is in
        order if it is so once a call costs {CALL_PRICE:g} flops or less (its break-even price is
        reported). It holds if both pairs agree in both accountings; with a correction if every pair
        agrees or is mixed and in order; otherwise it does not hold. Time per tick from results/timings
        confirms or not and is reported; where it contradicts the order, 'holds' falls to 'with a
        correction'. No timings: said so.
    """,
    open="Cost of a call depends on the machine; the paper gives no numbers at all, only an order.",
    readings=(
        "the goal is given in the law's own coordinates (the paper's accounting)",
        "the goal is a rotation matrix",
    ),
)
def c12(results):
    """Flops and calls of neighbours in both accountings; then time."""
    paper = [costs(results, law, with_goal=False) for law in LAWS]
    total = [costs(results, law, with_goal=True) for law in LAWS]
    pairs = [compared(*pair) for every in (paper, total) for pair in itertools.pairwise(every)]
    in_order = [how == AGREES or (how == MIXED and price <= CALL_PRICE) for how, price in pairs]
    timings = results.timings()
    said, timed_in_order = _timed(timings)
    word = word_of(timed_in_order and all(how == AGREES for how, _ in pairs), all(in_order))
    priced = ", ".join(f"once a call costs {price:.1f} flops" for how, price in pairs if how != AGREES) or "none"
    return word, evidence(
        f"""Flops and transcendental calls a tick: {_listed(paper)}; with the goal's angles taken from its matrix:
        {_listed(total)}. In order: {sum(how == AGREES for how, _ in pairs)} of {len(pairs)} pairs in both columns, the
        others {priced}. {said}""",
        2 * len(LAWS) + len(timings),
        ("costs", "timings") if len(timings) else ("costs",),
    )


def _listed(every) -> str:
    return ", ".join(f"{law} {flops} and {calls}" for law, (flops, calls) in zip(LAWS, every, strict=True))


def _timed(timings) -> tuple[str, bool]:
    """What the timings say, and whether none of them contradicts the order."""
    found = timings[timings["regulator"].isin(LAWS)].groupby(["machine", "regulator"], observed=True)["ns_per_tick"]
    table = found.median().unstack("regulator") if len(timings) else None
    if table is None or not set(LAWS) <= set(table.columns):
        return "No timings of all three laws to confirm it.", True
    in_order = (table[list(LAWS)].diff(axis=1).iloc[:, 1:] > 0).all(axis=1)
    times = ", ".join(f"{law} {table[law].median():.0f} ns" for law in LAWS)
    return f"Time a tick is in that order on {int(in_order.sum())} of {len(table)} machines ({times}).", in_order.all()


@claim(
    id="C17",
    section="2.5, 4",
    sentence="No regulator performs adequately in both calculation cost and performance.",
    question="Which of the three is adequate in which, on one plane of cost and performance?",
    criterion=f"""
        Adequate performance: (a) at least {SETTLED_SHARE:.1%} of the uniform starts settle; (b) so do at
        least {DIRECTED_SHARE:.0%} of the directed starts at rest (half-turn, poles, wraps, box, goals) that
        are not themselves on a half turn, a pole or a wrap to 1e-13 rad, nor their goals on a pole, and of
        random starts that spin, at each speed of results/maps, all but a share whose exact 95 % interval
        ends at {1 - SETTLED_SHARE:.1%} or below, those that do not converge counted as lost; (c) no uniform
        start takes longer than {SLOW:g} times the settling time of a small error. Adequate cost: flops plus
        {CALL_PRICE:g} for each transcendental call (paper's accounting of C12, typical branch) at most
        {DEAR:g} times the cheapest of the three. It holds if none of rotation-matrix, linearized-euler
        and feedback-linearized is adequate in both; with a correction if one is, but fails on starts that
        (b) leaves out, or not at every price of a call from {CALL_PRICES[0]:g} to {CALL_PRICES[1]:g};
        otherwise it does not hold. Later laws are put on the same plane with the same three numbers; they
        do not change this verdict, they answer C27.
    """,
    open="""
        'Adequate' is the paper's word without a number; (a) to (c) and the factor 2 are ours. (c) is what
        the paper calls uncertain settling times. Until November 2026 (b) asked that every directed start
        settle, 200 tumbling ones among them: whether one of these is lost hangs on the draw.
    """,
)
@on_every_engine
def c17(results, engine):
    """The three laws against the three tests of performance and the test of cost."""
    linear = closed_form.linear_settling(*results.gains())
    every = adequacy.every(results, engine)
    three = [one for one in every if one.name in THREE]
    if len(three) < len(THREE):
        raise NoEvidence(f"not all of {', '.join(THREE)} ran by {engine}: run a suite without narrowing it")
    cheapest = cheapest_of_the_papers(results)
    lacks = {one.name: set(adequacy.missed(one, cheapest, linear, {})) for one in three}
    both = [one.name for one in three if not lacks[one.name] & set(adequacy.BOTH)]
    word = word_of(not both, all(lacks[name] & {"e", "h"} for name in both))
    beside = probes.beside_pole(0.1, "feedback-linearized/zyx-euler", results.gains())
    later = [one for one in every if one.name not in adequacy.PAPERS]
    laws = "; ".join(_placed(one, cheapest) for one in sorted(three, key=lambda one: THREE.index(one.name)))
    adequate = ", ".join(_law(name) for name in THREE if name in both) or "none"
    others = "; ".join(map(_beside, later)) or "none in this run"
    return word, evidence(
        f"""{laws}. Adequate in both: {adequate}. Settling time of a small error: {linear:.3f} s.
        {_timed(results.timings())[0]} Not counted: feedback-linearized fails from {int((~settled(beside)).sum())} of
        {len(beside)} starts spinning at {probes.SPEED:g} rad/s beside a pole. Later laws on the same plane:
        {others}.""",
        len(LAWS) + sum(one.rows for one in (*three, *later)),
        ("episodes", "costs"),
    )


def _beside(one: adequacy.Adequacy) -> str:
    pace = f"slowest {one.slowest_s:.2f} s" if one.settled else "none in time"
    return (
        f"{one.name} {one.settled:.2%} and {one.lost} ({one.lost_exact}) lost, {pace}, {one.flops} flops and "
        f"{one.calls} calls"
    )


def cheapest_of_the_papers(results, prices=(CALL_PRICE, *CALL_PRICES)) -> dict[float, float]:
    """Price of a call -> cost of the cheapest of the paper's three."""
    spent = [costs(results, law, with_goal=False) for law in LAWS]
    return {price: min(flops + price * calls for flops, calls in spent) for price in prices}


def _law(name: str) -> str:
    return name.partition("/")[0]


def _placed(one: adequacy.Adequacy, cheapest: dict[float, float]) -> str:
    prices = [f"{price:g}" for price in sorted(cheapest) if one.cost(price) <= DEAR * cheapest[price]]
    cost = f"affordable with a call at {', '.join(prices)} flops" if prices else "affordable at no price of a call"
    return (
        f"{_law(one.name)}: {one.settled:.2%} of SO(3) settles, {one.lost} other starts do not ({one.lost_exact} more "
        f"of the exact ones), of spinning ones {'; '.join(map(lost_text, one.spun[-1:])) or 'none is known'}, slowest "
        f"{one.slowest_s:.2f} s, {one.flops} flops and {one.calls} calls, {cost}"
    )
