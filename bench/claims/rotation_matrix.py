"""C01 to C05: the regulator of Luh, Walker and Paul (Murphy 1988, 2.12-2.13 and 2.4)."""

from bench.claims.verdict import claim

STRAY_SHARE = 1e-3
"""Above one uniform start in 1,000 the starts that do not settle are no longer isolated orientations."""

ENERGY_SLACK = 1e-6
"""rad^2/s^2 over Kp: rounding and integration of an energy that never grows; the largest is 2."""

SMALL_ANGLES = (0.1, 0.01, 0.001)
GAINS = ((100.0, 20.0), (25.0, 10.0), (400.0, 40.0), (100.0, 10.0), (100.0, 40.0))
"""Critically damped at 10, 5 and 20 rad/s; then damping ratios 1/2 and 2 at 10 rad/s."""

LOOSE_SETTLING = 0.05
GAINS_TRIED = ", ".join(f"({kp:g}, {kv:g})" for kp, kv in GAINS)

SLOPE_DECADES = (3, 10)
"""Below 3 the sine is not yet linear in pi - angle; beyond 10, rounding of R (1e-16) exceeds 1e-6 of it."""

SLOPE_TIGHT, SLOPE_LOOSE = 0.01, 0.1
ZERO_ERROR = 2.0**-52
"""One rounding of an element of R."""

AWAY_RAD = 1e-3
NO_ZERO, NEAR_ZERO = 0.999, 1e-9

C01 = claim(
    id="C01",
    section="2.4",
    sentence="The rotation-matrix regulator is stable over the entire range of rotations.",
    question="Does any start diverge; and does every start reach the goal?",
    criterion=f"""
        Start sets uniform, half-turn and tumbling. Stable (Lyapunov) means: no episode ends diverged,
        singular or saturated, and none ends beyond its initial energy, 1 - cos(angle_end) <= 1 -
        cos(angle_0) + |omega_0|^2 / (2 Kp) + {ENERGY_SLACK:g}. It holds if that is so and every episode
        settles; it holds with a correction if that is so but some episodes do not settle (stable, yet not
        attracted from everywhere), as long as they are at most {STRAY_SHARE:.1%} of the uniform starts;
        otherwise it does not hold.
    """,
    open="""
        The paper gives no gains for this law (ours are those of the other two), no starts and no horizon;
        a start that has not settled at the horizon counts as not settled. The energy bound is free of all
        three.
    """,
    readings=(
        "stable: nothing diverges (the one judged)",
        "attracted: every start reaches the goal (what a correction says)",
    ),
)

C02 = claim(
    id="C02",
    section="2.4",
    sentence="Near zero its settling time can be chosen by the gains.",
    question="""
        Is the settling time of small rotations the closed form of the linear system, at every pair of
        gains?
    """,
    criterion=f"""
        Rotations of 0.1, 0.01 and 0.001 rad about x, y, z and a diagonal, at (Kp, Kd) = {GAINS_TRIED},
        and the small steps of the set goals. The closed form is the last time at which the response of
        x'' = -Kp x - Kd x' from 1 is 0.02, for the paper's gains (1 + 10 t) exp(-10 t) = 0.02. It holds
        if every settling time is within one tick plus angle^2 of it (sin x = x - x^3/6 softens the spring
        by angle^2/6); with a correction if within {LOOSE_SETTLING:.0%}; otherwise it does not hold.
    """,
    open="""
        The paper states no settling band; 2 % of the initial angle is ours, and the closed form uses the
        same.
    """,
)

C03 = claim(
    id="C03",
    section="2.4",
    sentence="For large rotations the settling time grows, and it can become infinite.",
    question="Does it grow with the angle, at which rate towards the half turn, and is it ever infinite?",
    criterion=f"""
        Three tests. Growth: mean settling time of uniform starts rises from each 30 degree bin of the
        initial angle to the next (bins of 5 starts or more). Rate: least squares over the set half-turn,
        pi - angle = 10^-k, k = {SLOPE_DECADES[0]} to {SLOPE_DECADES[1]}, gives a slope per decade within
        {SLOPE_TIGHT:.0%} of ln 10 / (sqrt(Kp + Kd^2/4) - Kd/2). Infinity: at least one exact half turn
        has not settled at its horizon, and that horizon is more than twice the longest settling time of
        the inexact ones. It holds if all three pass; with a correction if growth passes and the slope is
        within {SLOPE_LOOSE:.0%}, whatever infinity says; otherwise it does not hold.
    """,
    open="""
        The slope depends on the gains, which enter the formula; the horizon bounds what 'infinite' can
        mean.
    """,
)

C04 = claim(
    id="C04",
    section="2.4",
    sentence="""
        Example: a rotation of 180 degrees about any axis, because anti-parallel vectors have no cross
        product.
    """,
    question="""
        Is the error zero at exact half turns about every axis, does the body stay there, and for that
        reason?
    """,
    criterion=f"""
        At every exact half turn of the set half-turn: |e| of (2.12) at most {ZERO_ERROR:.1e} (one
        rounding). It holds if so, if none of these episodes settles, and if each of the three cross
        products of (2.12) vanishes by itself there (columns parallel or anti-parallel); with a correction
        if the error vanishes at all of them but some leave by rounding alone, or the three cross products
        cancel only in their sum; if the error is larger at any of them, it does not hold.
    """,
    open="""
        Whether a start stays is a matter of rounding, so of the engine and its step: each engine is
        reported. Gains and horizon decide how long an escape takes, not whether the error is zero.
    """,
)

C05 = claim(
    id="C05",
    section="2.4",
    sentence="""
        The elements of the cross product may also cancel in a series of points about the 180 degree
        rotation.
    """,
    question="Does the error vanish anywhere but at zero and at half turns?",
    criterion=f"""
        |e| of (2.12) against sin(angle), the angle by the judge, at every start of the run's tables with
        angle and pi - angle above {AWAY_RAD:g} rad, and by a search (downhill simplex on |e| / sin(angle)
        over rotation vectors, from 16 directions). It holds if |e| < {NEAR_ZERO:g} is found there; with a
        correction if |e| < {NO_ZERO} sin(angle) but no zero is found; if neither, it does not hold.
    """,
    open="Nothing: the error is a function of the orientation alone.",
    readings=(
        "zeros near, but not at, the half turn: the sentence says 'also' (the one judged)",
        """
            half turns about axes other than x, y, z, where no cross product is zero but their sum is: see
            C04
        """,
    ),
)

CLAIMS = (C01, C02, C03, C04, C05)
