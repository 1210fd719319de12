"""C20, C26: the controller on the Euler Jacobian, what it does and what it costs (Murphy 1988, 3.6-3.8 and 4)."""

from bench.claims.costs import CALL_PRICE, CALL_PRICES
from bench.claims.verdict import claim

LAW, COORDINATES = "feedback-linearized", "zyx-euler"
INVERSES = {6: "solve", 7: "pseudo-inverse"}
"""The inverse of the claims, by number of joints: what J^-1 means on six, and its least-squares heir on seven."""

BEND_TIGHT, BEND_LOOSE = 1e-3, 1e-2
"""rad, at step zero by Richardson. What the extrapolation leaves is of second order: (10/s x 1 ms)^2 = 1e-4, times a
motion of up to pi, times a few for the curvature of the angles. A visible bend is a hundredth, as in C09."""

DRIFT_M = 1e-3
"""m, at step zero: a thousandth of an arm's reach."""

HALVING = (0.4, 0.6)
"""Departure at half the step over that at the step: a half if it is the integrator's, of first order; one if it is the
law's. A second-order part of -0.3 to 0.7 of the first-order one moves it this far from a half."""

HAMMERED = 10.0
"""Peak torque over that of the geometric Jacobian from the same start: beyond it the Jacobian is to blame."""

C20 = claim(
    id="C20",
    section="3.2",
    sentence="With it the plant is decoupled double integrators; this fails at places and hides a cost.",
    question="Is the arm's answer linear, how does it end near the pole, and what do (2.2), (3.7) cost?",
    criterion=f"""
        Native engine, every arm, perfect model, law (3.7): {LAW}/{COORDINATES}@analytic with the inverse {INVERSES[6]}
        on six joints and {INVERSES[7]} on seven. Against it: rotation-matrix@geometric, (2.2), with the same inverse.
        (a) Double integrators: from clear starts, each angle's departure from E_d + (E_0 - E_d) response(t), the closed
        form of C09, is the integration error of MuJoCo's semi-implicit Euler step, which is of first order: with half
        the step it is {HALVING[0]:g} to {HALVING[1]:g} of what it was, and extrapolated to step zero (twice the
        half-step trace less the full) at most {BEND_TIGHT:g} rad; the tool's position likewise, at most {DRIFT_M:g} m.
        (b) Orientations: on every arm some start at a pole fails with it that settles with the other, where failing is
        not settling, or a peak torque {HAMMERED:g} times the other's; no clear start fails. Starts at a pole are those
        of the set pole, and the poses of C18's families at 10^-2 or nearer, at rest, with the pose at 10^-1 for a goal.
        (c) Hidden expense: by costs.parquet, typical branch, its stage 'regulate' has fewer flops and no more calls
        than the other's, and yet its total without the goal's angles costs more, flops and calls at {CALL_PRICES[0]:g}
        to {CALL_PRICES[1]:g} flops each, on six and on seven joints. It holds if all three pass; with a correction if
        (a) extrapolates to {BEND_LOOSE:g} rad or less and (b) or (c) passes; otherwise it does not hold. Also reported:
        (2.2) with (2.15), the same law on the geometric Jacobian.
    """,
    open="""
        "The result is truly a system of decoupled double integrators." "However, this linearization fails to exist for
        certain orientations mentioned above and it hides the expense of calculating the Euler angles." The paper
        computes no arm. The halved step is an experiment of the judge's, and so are the episodes from C18's poses: a
        response in E is straight in E, so it nears a pole only from there or to there, while the starts of the set pole
        begin and end 40 degrees away from one, and only the tool of a law on R passes it.
    """,
)

C26 = claim(
    id="C26",
    section="4",
    sentence="The Euler Jacobian costs more to calculate.",
    question="What do the tallies of both say?",
    criterion=f"""
        costs.parquet, typical branch, on six joints with {INVERSES[6]} and on seven with {INVERSES[7]}: whole
        controllers, what MuJoCo computes for all of them left out. Pairs, the cheaper by the claim first: the same law
        both ways, {LAW}/{COORDINATES}@geometric, (2.2) with (2.15), and @analytic, (3.7); and
        rotation-matrix@geometric, (2.2), and the latter. Flops and calls in columns of their own, with the goal's
        angles and without (the paper's accounting), as in C12: a pair agrees if the dearer has no fewer of either and
        more of one; it is mixed if the columns differ, and in order if it is so once a call costs {CALL_PRICE:g} flops
        or less. It holds if every pair agrees; with a correction if every pair agrees or is mixed and in order;
        otherwise it does not hold. Times per tick of whole controllers, where results/timings has them, are reported;
        where they contradict the order, 'holds' falls to 'with a correction'.
    """,
    open="""
        "This Jacobian is commonly used in the literature without statement to the fact that it must exclude certain
        orientations and has a higher calculation cost." Higher than what is not said: than the common Jacobian with the
        same law is the narrow reading, than the cheapest controller without Euler angles the wide one; both are asked.
    """,
    readings=(
        "dearer than the same law on the common Jacobian",
        "dearer than the law on R on the common Jacobian",
    ),
)

CLAIMS = (C20, C26)
