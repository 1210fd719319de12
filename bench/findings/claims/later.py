"""C27: the open question (Murphy 1988, 4), asked of every law that came after the paper's three."""

import numpy as np

from bench.findings.claims import adequacy, costs
from bench.findings.claims.adequacy import CALL_PRICE, CALL_PRICES, DEAR, DETOUR, PAPERS, SETTLED_SHARE, SLOW, Adequacy
from bench.findings.claims.tables import evidence, on_every_engine
from bench.findings.claims.verdict import NoEvidence, Word, claim
from bench.findings.theory import closed_form

HELD_RAD = 0.1
"""Greatest worst-case noise near the half turn that must not hold a law there: six degrees, which no sensor of
orientation in use exceeds by much, and far less than any law's memory could bridge."""


@claim(
    id="C27",
    section="4",
    sentence="The problem is open: a better regulator on the rotation matrix, and other representations, are wanted.",
    question="Which later law is adequate in both cost and performance by the criterion of C17?",
    criterion=f"""
        Asked of every law of the run that is none of the paper's, in any coordinates. Adequate as in C17:
        (a) at least {SETTLED_SHARE:.1%} of the uniform starts settle; (b) no more of the
        directed and of the spinning starts are lost than C17 allows; (c) no uniform start takes longer than
        {SLOW:g} times the settling time of a small error; (d) flops plus
        {CALL_PRICE:g} for each call (typical branch, without the goal's own stage) at most {DEAR:g} times the
        cheapest of the paper's three. An answer must also (e) settle from the directed starts that
        C17 leaves out, every exact half turn, pole and wrap; (f) leave every half turn
        under worst-case noise of up to {HELD_RAD:g} rad (robustness.parquet, half-turn-noise: no start that
        fails to settle); (g) not unwind: from uniform starts and half turns it travels less than {DETOUR:g}
        times the shortest way; (h) keep (d) at every price of a call from {CALL_PRICES[0]:g} to
        {CALL_PRICES[1]:g}. It holds (the problem is still open) if no law is adequate in (a) to (d); with a
        correction if one is, but none of those has (e) to (h) too; otherwise it does not hold, and the
        laws that have all eight answer it. What each other law lacks is reported.
    """,
    open="""
        The paper asks for 'better' without a number; C17's numbers are kept, so nothing was chosen to let a
        law in or out. Memory is the price of (f): without it no law can have (e) and (f) both (Bhat and
        Bernstein 2000; Mayhew, Sanfelice and Teel 2011). Operation counts were known when this was written;
        no episode had been judged by it. Afterwards laws on the quaternion were written with fewer
        operations for the same command (hybrid 89, then 74, then 69 flops; mrp-linearized 114, then 87):
        before, hybrid missed (d), then (h) alone, and no law had all eight. The property is tested on
        samples: it is no proof.
    """,
)
@on_every_engine
def c27(results, engine):
    """Each later law against the eight tests."""
    every = adequacy.every(results, engine)
    later = [one for one in every if one.name not in PAPERS]
    held = adequacy.held(results, HELD_RAD)
    if not any(one.name in held for one in later):
        raise NoEvidence(
            f"no later law by {engine} on which noise was tried: run the suite 'quick', 'default' or 'full' without "
            "narrowing it"
        )
    small = closed_form.linear_settling(*results.gains())
    cheapest = costs.cheapest_of_the_papers(results)
    lacks = {one.name: adequacy.missed(one, cheapest, small, held) for one in later}
    adequate = [one for one in later if not set(lacks[one.name]) & set(adequacy.BOTH)]
    answers = [one for one in adequate if not lacks[one.name]]
    nearly = [one for one in adequate if lacks[one.name] == adequacy.TESTS[-1]]
    word = Word.FAILS if answers else Word.CORRECTED if adequate else Word.HOLDS
    parts = {
        "adequate": ", ".join(one.name for one in adequate) or "none",
        "answers": "; ".join(_told(one) for one in answers) or "none",
        "nearly": "; ".join(f"{_told(one)}, {_from(one, results)}" for one in nearly) or "none",
    }
    lacking = "; ".join(f"{one.name} {_letters(lacks[one.name])}" for one in later if lacks[one.name]) or "nothing"
    return word, evidence(
        f"""Of {len(later)} later laws adequate in both cost and performance: {parts["adequate"]}. All eight tests:
        {parts["answers"]}. All but the last: {parts["nearly"]}. What each lacks: {lacking}. Cost counts a call as
        {CALL_PRICE:g} flops and may be {DEAR * cheapest[CALL_PRICE]:g}; a small error settles in {small:.3f} s, and
        {SLOW * small:.3f} s is the slowest that is adequate.""",
        sum(one.rows + held.get(one.name, (0, 0))[1] for one in later),
        ("episodes", "costs", "robustness"),
        **parts,
    )


def least_price(one: Adequacy, results) -> float:
    """Price of a call, to a hundredth of a flop, from which on a law is no dearer than is adequate; inf: none."""
    prices = np.linspace(*CALL_PRICES, 1901)
    least = costs.cheapest_of_the_papers(results, prices)
    dear = [price for price in prices if one.cost(price) > DEAR * least[price]]
    if not dear:
        return CALL_PRICES[0]
    return float(min((price for price in prices if price > max(dear)), default=np.inf))


def _told(one: Adequacy) -> str:
    return (
        f"{one.name} ({one.flops} flops and {one.calls} calls, {one.settled:.2%} of {one.n} starts settle, slowest "
        f"{one.slowest_s:.2f} s, way at most {one.detour:.2f} times the shortest)"
    )


def _from(one: Adequacy, results) -> str:
    price = least_price(one, results)
    return f"of adequate cost from {price:.2f} flops a call on" if np.isfinite(price) else "dear where calls are"


def _letters(missed: str) -> str:
    return f"({', '.join(missed)})"
