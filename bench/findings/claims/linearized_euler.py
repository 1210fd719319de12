"""C06 to C08: PD on Z-Y-X Euler angles linearized about zero (Murphy 1988, 2.14 and 2.4)."""

import functools
import math

import numpy as np

from bench.experiments.suites import SHORT
from bench.findings.claims import probes
from bench.findings.claims.tables import evidence, lost, on_every_engine, settled, share, some
from bench.findings.claims.verdict import Earlier, Word, claim, word_of
from bench.findings.theory import held_goals
from bench.tables.read import converged
from bench.tables.statistics import bootstrap, quantile
from tasks.base import IDENTITY, Start
from tasks.sphere import axes

LAW, CURE = "linearized-euler", "linearized-euler-relative"
NEAR_GOAL_RAD, NEAR_GOALS = 0.3, 16

INSIDE_TIGHT, INSIDE_LOOSE, OUTSIDE_SHARE = 0.99, 0.9, 0.5
"""'Approximate' allows 1 % of the box to fail, or 10 % with a correction; a range that most of its outside shares is
no description of it."""

PASSING = 0.05
"""cos(beta): within 2.9 degrees of the pole, where 1/cos(beta) multiplies rates by 20 or more."""

PEAK_EXTREME, PEAK_RAISED = 10.0, 2.0
FAIL_EXTREME, FAIL_REST, FAIL_RAISED = 0.5, 0.1, 3.0
FEW_GOALS, MANY_GOALS, CURE_SLACK = 0.05, 0.5, 0.05


@claim(
    id="C06",
    section="2.4",
    quote="""
        An approximate range of Euler angles for which the system was stable was found to be -pi/2 < alpha <
        pi/2, -pi/2 < beta < pi/2, -pi < gamma < pi.
    """,
    value="|alpha|, |beta| < pi/2, |gamma| < pi",
    correction="The box is a part of the range: most of what lies outside it is stable too.",
    written="2026-11-23 2749c2a",
    sentence="The linearized regulator is stable for about |alpha| < pi/2, |beta| < pi/2, |gamma| < pi.",
    question="How much of SO(3) settles, and is the box the region that does?",
    criterion=f"""
        Starts at rest with goal zero; stable means settled at the horizon. Every orientation has |beta|
        <= pi/2 and |gamma| <= pi, so the box is |alpha| < pi/2, exactly half of SO(3). Inside: uniform
        starts in it, and the grid and inside shells of the set box. It holds if at least
        {INSIDE_TIGHT:.0%} of the uniform starts inside and {INSIDE_TIGHT:.0%} of the box set's inside
        ones settle, and at least {OUTSIDE_SHARE:.0%} of the uniform starts outside do not; with a
        correction if at least {INSIDE_LOOSE:.0%} of both inside ones settle; otherwise it does not hold.
        Starts that do not converge are left out and counted. Shares carry Wilson 95 % intervals; the
        nearest boundary along geodesics is reported from boundaries.parquet.
    """,
    open="""
        The paper gives the gains (100, 20) but not which starts were tried, nor whether all three angles
        were large at once. A start that is still moving at the horizon counts as not stable.
    """,
    earlier=(
        Earlier(
            "2026-11-21 9072535",
            "Starts whose end depends on the step counted as failures.",
            Word.CORRECTED,
        ),
    ),
)
@on_every_engine
def c06(results, engine):
    """Shares that settle inside and outside the box, and the nearest boundary."""
    every = results.episodes(LAW, engine, "uniform", "box")
    sure = converged(every)
    uniform = sure[sure["start_set"] == "uniform"]
    is_inside = uniform["alpha0"].abs() < math.pi / 2
    whole, inside = share(settled(uniform)), share(settled(uniform[is_inside]))
    outside = share(settled(uniform[~is_inside]))
    box = some(sure[sure["start_id"].str.contains("box-grid|box-inside")], "start inside the box")
    directed = share(settled(box))
    fails = results.free_body("boundaries", regulator=LAW)["fails_from_rad"].dropna()
    least = min(inside.value, directed.value)
    word = word_of(least >= INSIDE_TIGHT and outside.value <= 1 - OUTSIDE_SHARE, least >= INSIDE_LOOSE)
    how = uniform["outcome"][~settled(uniform)]
    ends = ", ".join(f"{end} ({n:,})" for end, n in how.value_counts().items() if n) or "in no other way"
    nearest = float(np.degrees(fails.min())) if len(fails) else math.nan
    return word, evidence(
        f"""Settled: {whole} of SO(3); inside the box {inside}, of the box set's inside starts {directed}; outside
        {outside}. The uniform ones that fail end {ends}. The nearest failure on a geodesic from the goal is at
        {nearest:.1f} degrees. {len(every) - len(sure)} of the starts do not converge.""",
        len(every) + len(fails),
        ("episodes", "boundaries"),
    )


@claim(
    id="C07",
    section="2.4",
    quote="""
        Because of the calculation methods for E and Edot, the regulator had extreme difficulties whenever beta
        passed through +-pi/2.
    """,
    correction="At the pole commands and losses rise, but not to extremes.",
    written="2026-11-23 2749c2a",
    sentence="It has extreme difficulties whenever beta passes through +-pi/2.",
    question="How do episodes that come near the pole end, and what do they command, against the rest?",
    criterion=f"""
        Uniform starts with cos(beta_0) >= {PASSING}; 'passing' are those whose smallest cos(beta) falls
        below {PASSING}. Only what no shorter step moves counts: episodes that do not converge are in no
        median, and are taken once as settled and once as lost, whichever is worse for the stronger word.
        It holds if the median peak command of the passing ones is at least {PEAK_EXTREME:g} times the
        rest's, or at least {FAIL_EXTREME:.0%} of them do not settle while at most {FAIL_REST:.0%} of the
        rest do not; with a correction if the median peak is at least {PEAK_RAISED:g} times, or their
        share that does not settle at least {FAIL_RAISED:g} times the rest's; otherwise it does not hold.
        All by the nearer ends of 95 % intervals: of medians by resampling, of shares exact.
    """,
    open="""
        Sampled engines are compared: a sampled law can step over the pole.
    """,
    earlier=(
        Earlier(
            "2026-11-21 9072535",
            """
            The same of every episode at a step of 1 ms, converged or not, and by the numbers themselves instead of
            their intervals' ends.
            """,
            Word.HOLDS,
        ),
    ),
)
@on_every_engine
def c07(results, engine):
    """Outcome and peak command of episodes that come near the pole, against the rest."""
    frame = results.episodes(LAW, engine, "uniform")
    frame = frame[np.cos(frame["beta0"]) >= PASSING]
    near = frame["min_margin"] < PASSING
    passing, rest = some(frame[near], "episode that comes near the pole"), some(frame[~near], "other episode")
    lost_passing, lost_rest = lost(passing), lost(rest)
    peak, rest_peak = _median_peak(passing), _median_peak(rest)
    ratio = peak.low / rest_peak.high
    is_extreme = lost_passing.low >= FAIL_EXTREME and lost_rest.high <= FAIL_REST
    is_raised = ratio >= PEAK_RAISED or lost_passing.low >= FAIL_RAISED * lost_rest.high
    word = word_of(ratio >= PEAK_EXTREME or is_extreme, is_raised)
    poles = results.episodes(LAW, engine, "poles")
    poles = poles[probes.boundary_distance(poles)["pole"] > probes.EXACT_RAD]
    beside = converged(poles)
    return word, evidence(
        f"""{len(passing)} episodes come within {math.degrees(math.asin(PASSING)):.1f} degrees of the pole; of the
        {len(converged(passing))} that converge {lost_passing.value:.2%} do not settle ({lost_passing.low:.2%} to
        {lost_passing.high:.2%}, the others settling or lost), against {lost_rest.value:.2%} ({lost_rest.low:.2%} to
        {lost_rest.high:.2%}) of the rest. Their median peak command is {peak.value:,.0f} rad/s^2 ({peak.low:,.0f} to
        {peak.high:,.0f}) against {rest_peak.value:,.0f} ({rest_peak.low:,.0f} to {rest_peak.high:,.0f}). From rest
        beside the pole {int(settled(beside).sum())} of {len(beside)} that converge settle, and
        {len(poles) - len(beside)} do not converge.""",
        len(frame) + len(poles),
        ("episodes",),
    )


def _median_peak(frame):
    """Of the episodes that converge, with the interval of the median."""
    peaks = some(converged(frame), "episode that converges")["peak_u"].to_numpy()
    return bootstrap(peaks, functools.partial(quantile, level=0.5))


@claim(
    id="C08",
    section="2.4",
    quote="""
        this regulator was not sufficient to drive the end effector rotation to any other coordinate other than
        [0 0 0]^T. This problem may be avoided by defining the desired rotation as the zero point
    """,
    correction="With E_d subtracted it reaches goals near zero, and some far from it.",
    written="2026-11-23 953f62a",
    sentence="It cannot drive to any coordinates but zero; angles taken from the desired orientation avoid that.",
    question="""
        What share of far goals does it reach with E_d subtracted, and what share with angles from the
        goal?
    """,
    criterion=f"""
        Set goals, laws linearized-euler (E_d subtracted) and linearized-euler-relative (angles of R_d^T
        R); shares with 95 % intervals. The cure works if the relative law's interval on goals reaches to within
        {CURE_SLACK:.0%} of its interval on uniform (goal zero), and lies above the base law's. It holds if the cure
        works and the base law settles on at most {FEW_GOALS:.0%} of the goals, none of them a goal within 0.3
        rad of zero (16 directions, from zero); with a correction if the cure works and it settles on less
        than {MANY_GOALS:.0%}, by the whole interval; otherwise it does not hold.
    """,
    earlier=(
        Earlier(
            "2026-11-21 9072535",
            "The same of the shares themselves, which another sample of goals can turn.",
            Word.CORRECTED,
        ),
    ),
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
@on_every_engine
def c08(results, engine):
    """Far goals with E_d subtracted and with angles from the goal; near goals with E_d subtracted."""
    base = share(settled(results.episodes(LAW, engine, "goals")))
    cure = share(settled(results.episodes(CURE, engine, "goals")))
    zero = share(settled(results.episodes(CURE, engine, "uniform")))
    starts = [Start("", IDENTITY, goal_wxyz=probes.about(axis, NEAR_GOAL_RAD)) for axis in axes(NEAR_GOALS)]
    near = share(probes.episodes(LAW, starts, results.gains(), results.dt_s, SHORT)["outcome"] == "settled")
    works = cure.high >= zero.low - CURE_SLACK and cure.low > base.high
    word = word_of(works and base.high <= FEW_GOALS and not near.k, works and base.high < MANY_GOALS)
    return word, evidence(
        f"""With E_d subtracted it reaches {base} of the goals, and {near.k} of {near.n} goals {NEAR_GOAL_RAD} rad from
        zero; with angles from the goal {cure} of the goals, against {zero} of uniform starts with goal zero. By its
        eigenvalues it holds {held_goals.held_share(results.gains()):.1%} of all goals: those with alpha_d under
        {math.degrees(math.acos(held_goals.least_cosine(0.0, results.gains()))):.1f} degrees at beta_d = 0 and under 90
        at the poles, whatever gamma_d. As printed, u contains no goal.""",
        base.n + cure.n + zero.n + near.n,
        ("episodes", "experiment"),
    )
