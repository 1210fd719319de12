"""C12 and C17: cost of calculation, and cost against performance (Murphy 1988, 2.5 and 4)."""

from bench.claims.verdict import claim

CALL_PRICE, CALL_PRICES = 10.0, (1.0, 20.0)
"""Flops that one sin, cos, atan2 or acos stands for where two columns must become one; the range tried."""

SETTLED_SHARE, SLOW, DEAR = 0.999, 2.0, 2.0
EXACT_RAD = 1e-13
"""As in feedback_linearized: between the nearest near start (1e-12 rad) and rounding."""

C12 = claim(
    id="C12",
    section="2.5",
    sentence="""
        Cost rises from the rotation-matrix law over the linearized to the feedback-linearized law.
    """,
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

C17 = claim(
    id="C17",
    section="2.5, 4",
    sentence="No regulator performs adequately in both calculation cost and performance.",
    question="Which of the three is adequate in which, on one plane of cost and performance?",
    criterion=f"""
        Adequate performance: (a) at least {SETTLED_SHARE:.1%} of the uniform starts settle; (b) every
        directed start settles (half-turn, poles, wraps, box, tumbling, goals) that is not itself on a
        half turn, a pole or a wrap to 1e-13 rad, nor its goal on a pole; (c) no uniform start takes
        longer than {SLOW:g} times the settling time of a small error. Adequate cost: flops plus
        {CALL_PRICE:g} for each transcendental call (paper's accounting of C12, typical branch) at most
        {DEAR:g} times the cheapest of the three. It holds if none of rotation-matrix, linearized-euler
        and feedback-linearized is adequate in both; with a correction if one is, but fails on starts that
        (b) leaves out, or not at every price of a call from {CALL_PRICES[0]:g} to {CALL_PRICES[1]:g};
        otherwise it does not hold. Later laws are put on the same plane with the same three numbers; they
        do not change this verdict, they answer C27.
    """,
    open="""
        'Adequate' is the paper's word without a number; (a) to (c) and the factor 2 are ours. (c) is what
        the paper calls uncertain settling times.
    """,
)

CLAIMS = (C12, C17)
