"""C06 to C08: PD on Z-Y-X Euler angles linearized about zero (Murphy 1988, 2.14 and 2.4)."""

from bench.claims.verdict import claim

INSIDE_TIGHT, INSIDE_LOOSE, OUTSIDE_SHARE = 0.99, 0.9, 0.5
"""'Approximate' allows 1 % of the box to fail, or 10 % with a correction; a range that most of its outside shares is
no description of it."""

PASSING = 0.05
"""cos(beta): within 2.9 degrees of the pole, where 1/cos(beta) multiplies rates by 20 or more."""

PEAK_EXTREME, PEAK_RAISED = 10.0, 2.0
FAIL_EXTREME, FAIL_REST, FAIL_RAISED = 0.5, 0.1, 3.0
FEW_GOALS, MANY_GOALS, CURE_SLACK = 0.05, 0.5, 0.05

C06 = claim(
    id="C06",
    section="2.4",
    sentence="The linearized regulator is stable for about |alpha| < pi/2, |beta| < pi/2, |gamma| < pi.",
    question="How much of SO(3) settles, and is the box the region that does?",
    criterion=f"""
        Starts at rest with goal zero; stable means settled at the horizon. Every orientation has |beta|
        <= pi/2 and |gamma| <= pi, so the box is |alpha| < pi/2, exactly half of SO(3). Inside: uniform
        starts in it, and the grid and inside shells of the set box. It holds if at least
        {INSIDE_TIGHT:.0%} of the uniform starts inside and {INSIDE_TIGHT:.0%} of the box set's inside
        ones settle, and at least {OUTSIDE_SHARE:.0%} of the uniform starts outside do not; with a
        correction if at least {INSIDE_LOOSE:.0%} of both inside ones settle; otherwise it does not hold.
        Shares carry Wilson 95 % intervals; the nearest boundary along geodesics is reported from
        boundaries.parquet.
    """,
    open="""
        The paper gives the gains (100, 20) but not which starts were tried, nor whether all three angles
        were large at once. A start that is still moving at the horizon counts as not stable.
    """,
)

C07 = claim(
    id="C07",
    section="2.4",
    sentence="It has extreme difficulties whenever beta passes through +-pi/2.",
    question="How do episodes that come near the pole end, and what do they command, against the rest?",
    criterion=f"""
        Uniform starts with cos(beta_0) >= {PASSING}; 'passing' are those whose smallest cos(beta) falls
        below {PASSING}. It holds if the median peak command of the passing ones is at least
        {PEAK_EXTREME:g} times the rest's, or at least {FAIL_EXTREME:.0%} of them do not settle while at
        most {FAIL_REST:.0%} of the rest do not; with a correction if the median peak is at least
        {PEAK_RAISED:g} times, or their share that does not settle at least {FAIL_RAISED:g} times the
        rest's; otherwise it does not hold.
    """,
    open="""
        The size of the command depends on the tick: a sampled law can step over the pole. Engines are
        compared.
    """,
)

C08 = claim(
    id="C08",
    section="2.4",
    sentence="""
        It cannot drive to any coordinates but zero; angles taken from the desired orientation avoid that.
    """,
    question="""
        What share of far goals does it reach with E_d subtracted, and what share with angles from the
        goal?
    """,
    criterion=f"""
        Set goals, laws linearized-euler (E_d subtracted) and linearized-euler-relative (angles of R_d^T
        R). The cure works if the relative law settles on goals at no less than its own share on uniform
        (goal zero) minus {CURE_SLACK:.0%}, and at more than the base law does. It holds if the cure works
        and the base law settles on at most {FEW_GOALS:.0%} of the goals, none of them a goal within 0.3
        rad of zero (16 directions, from zero); with a correction if the cure works and it settles on less
        than {MANY_GOALS:.0%}; otherwise it does not hold.
    """,
    open="""
        Which goals the paper tried is not said; ours are more than a quarter turn from zero. Gains as in
        the paper.
    """,
    readings=(
        """
            as printed, u = -Kp E - Kd Edot has no goal: zero is the only point it can rest at, by its
            formula
        """,
        """
            with E_d subtracted, as for the third regulator (the one judged: the paper speaks of
            simulations)
        """,
    ),
)

CLAIMS = (C06, C07, C08)
