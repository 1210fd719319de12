"""C09 to C11: feedback linearization in Z-Y-X Euler angles (Murphy 1988, 2.15-2.16 and 2.4)."""

from bench.claims.verdict import claim

LINEAR_TIGHT, LINEAR_LOOSE = 1e-4, 1e-2
"""rad: Runge-Kutta of order 4 at 1 ms errs by far less on a time constant of 0.1 s; a visible bend is a hundredth."""

STRAY_SHARE = 0.01
GROWTH_DECADES = (3, 8)
SPIN = (4.0, -8.0, 6.0)
"""rad/s, any direction: the terms that grow, about 58 / cos(beta), then exceed the spring term 100 pi from cos(beta)
= 0.1 on."""

GROWTH_SLACK, JUMP_SLACK = 0.05, 0.01
MARGINS_RAD = (0.01, 0.05, 0.1, 0.2)
MARGINS = ", ".join(f"{margin:g}" for margin in MARGINS_RAD)

EXACT_RAD = 1e-13
"""Between the nearest of the near starts (1e-12 rad) and what rounding leaves of an exact one (4e-16 rad)."""

C09 = claim(
    id="C09",
    section="2.4",
    sentence="""
        The response is linear over the whole range of Euler angles but alpha, gamma = +-pi and beta =
        +-pi/2.
    """,
    question="Does every coordinate follow its linear closed form, and where does that end?",
    criterion=f"""
        From rest, goal zero. Linear: in every trace, each angle stays within {LINEAR_TIGHT:g} rad of E_0
        (1 + 10 t) exp(-10 t) (in general the solution of E'' = -Kp E - Kd E'). Off the boundary: every
        uniform start and every inexact start of poles and wraps settles. On it: every exact start of
        poles and wraps fails to settle. Spinning: every tumbling start settles. Goals: every goal off the
        pole is reached. It holds if all five pass; with a correction if the traces stay within
        {LINEAR_LOOSE:g} rad and at most {STRAY_SHARE:.0%} of the uniform starts do not settle, but any of
        the rest fails: the exception is then smaller or larger than stated; otherwise it does not hold.
        Also reported: the share of goals turned the long way round (more than pi travelled, which no
        shortest way is).
    """,
    open="""
        The paper starts at rest and regulates to zero; initial velocities, and goals across a jump, are
        ours. The gains (100, 20) are the paper's. Linear in E is not the shortest way, and not linear in
        the angle.
    """,
)

C10 = claim(
    id="C10",
    section="2.4",
    sentence="""
        beta = +-pi/2 divides by zero in elements of B; passing alpha, gamma = +-pi jumps through atan2.
    """,
    question="What does the law command at and near the pole, and across the jump?",
    criterion=f"""
        Pole: at exact poles, at rest and spinning, the command is not a finite number and no episode
        settles. Growth: for a body spinning at (4, -8, 6) rad/s log |u| against log cos(beta), at pi/2 -
        |beta| = 10^-k, k = {GROWTH_DECADES[0]} to {GROWTH_DECADES[1]}, has a slope within
        {GROWTH_SLACK:.0%} of -1. Jump: between 1e-9 rad before and behind +-pi, alpha or gamma, the
        command changes by 2 pi Kp within {JUMP_SLACK:.0%}. Where: elements of B (2.8) are not finite at
        the pole. It holds if all four pass; with a correction if pole and jump pass but growth or where
        does not (the division may be in B^-1 only); if the command stays finite at an exact pole, or does
        not jump, it does not hold.
    """,
    open="""
        How the angles are extracted at the exact pole, and 0/0, are left to the program: the paper says
        'divide by zero' and so do IEEE numbers. Gains enter the jump.
    """,
)

C11 = claim(
    id="C11",
    section="2.4",
    sentence="""
        Excluding a small region about the boundary points keeps the regulator from passing them
        erratically.
    """,
    question="How wide must the excluded region be, for bodies at rest and for spinning ones?",
    criterion=f"""
        An episode is erratic if it does not settle or its peak command exceeds twice Kp sqrt(3) pi + 20
        Kd (spring and damping at most, at 20 rad/s). For margins {MARGINS} rad: starts with pi/2 -
        |beta_0|, pi - |alpha_0| and pi - |gamma_0| all above the margin, at rest (uniform, half-turn,
        poles, wraps, box) and spinning (tumbling). It holds if for some margin none is erratic, at rest
        or spinning; with a correction if that is so at rest only: a start's place then does not assure
        it, its velocity counts; if erratic ones remain at rest for every margin, it does not hold.
    """,
    open="""
        'Small' is not given a number; 0.2 rad (11 degrees) is the widest that we call small. What the
        robot does in the excluded region is not said either.
    """,
    readings=(
        "the region is kept free of initial orientations (the one judged)",
        """
            the region is never entered on the way: reported from the smallest cos(beta) of each episode
        """,
    ),
)

CLAIMS = (C09, C10, C11)
