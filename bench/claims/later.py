"""C27: the open question (Murphy 1988, 4), asked of every law that came after the paper's three."""

from bench.claims.costs import CALL_PRICE, CALL_PRICES, DEAR, SETTLED_SHARE, SLOW
from bench.claims.verdict import claim

HELD_RAD = 0.1
"""Greatest worst-case noise near the half turn that must not hold a law there: six degrees, which no sensor of
orientation in use exceeds by much, and far less than any law's memory could bridge."""

DETOUR = 1.5
"""Path over shortest path from which a start at rest counts as unwinding: halfway to a full turn from a half turn is
3/2, and no spring that pulls towards the goal goes so far."""

C27 = claim(
    id="C27",
    section="4",
    sentence="""
        The problem is open: a better regulator on the rotation matrix, and other representations, are wanted.
    """,
    question="Which later law is adequate in both cost and performance by the criterion of C17?",
    criterion=f"""
        Asked of every law of the run that is none of the paper's, in any coordinates. Adequate as in C17:
        (a) at least {SETTLED_SHARE:.1%} of the uniform starts settle; (b) every directed start settles that
        C17 counts; (c) no uniform start takes longer than {SLOW:g} times the settling time of a small
        error; (d) flops plus {CALL_PRICE:g} for each call (typical branch, without the goal's own stage) at
        most {DEAR:g} times the cheapest of the paper's three. An answer must also (e) settle from the
        directed starts that C17 leaves out, every exact half turn, pole and wrap; (f) leave every half turn
        under worst-case noise of up to {HELD_RAD:g} rad (robustness.parquet, half-turn-noise: no start that
        fails to settle); (g) not unwind: from uniform starts and half turns it travels less than {DETOUR:g}
        times the shortest way; (h) keep (d) at every price of a call from {CALL_PRICES[0]:g} to
        {CALL_PRICES[1]:g}. It holds (the problem is still open) if no law is adequate in (a) to (d); with a
        correction if one is, but none of those has (e) to (h) too; otherwise it does not hold, and the
        laws that have all eight answer it. What each other law lacks is reported.
    """,
    open="""
        The paper asks for 'better' without a number; C17's numbers are kept, so nothing was chosen to let a
        law in or out. (f) is the price of memory: without it no law can have (e) and (f) both (Bhat and
        Bernstein 2000; Mayhew, Sanfelice and Teel 2011). Operation counts were known when this was written;
        no episode had been judged by it. The property is tested on samples: it is no proof.
    """,
)

CLAIMS = (C27,)
