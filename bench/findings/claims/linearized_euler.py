"""C06 to C08 and C29: PD on Z-Y-X Euler angles linearized about zero (Murphy 1988, 2.14 and 2.4)."""

import math

import numpy as np

from bench.experiments.suites import SHORT
from bench.experiments.tables.read import converged
from bench.experiments.tables.statistics import quantile_estimate
from bench.findings.claims import probes
from bench.findings.claims.at_gains import on_every_engine
from bench.findings.claims.rotation_matrix import GAINS, LOOSE_SETTLING, SMALL_ANGLES
from bench.findings.claims.tables import Results, evidence, interval, lost, settled, settled_of, share, some
from bench.findings.claims.verdict import Evidence, Word, claim, read_limits, word_of
from bench.findings.theory import closed_form, held_goals
from bench.law.inputs import Gains
from tasks.base import IDENTITY, Start
from tasks.haar import axes

LIMIT = read_limits(__file__)


LAW, CURE = "linearized-euler", "linearized-euler-relative"


@claim("C06")
@on_every_engine
def c06(results: Results, engine: str) -> tuple[Word, Evidence]:
    """Shares that settle inside and outside the box, and the nearest boundary."""
    every = results.episodes(LAW, engine, "uniform", "box")
    sure = converged(every)
    uniform = sure[sure["start_set"] == "uniform"]
    is_inside = uniform["alpha0"].abs() < math.pi / 2
    box = some(sure[sure["start_id"].str.contains("box-grid|box-inside")], "start inside the box")
    parts = (uniform, uniform[is_inside], uniform[~is_inside], box)
    whole, inside, outside, directed = (share(settled(part)) for part in parts)
    fails = results.free_body("boundaries", regulator=LAW)["fails_from_rad"].dropna()
    least = min(inside.value, directed.value)
    word = word_of(
        least >= LIMIT.INSIDE_TIGHT and outside.value <= 1 - LIMIT.OUTSIDE_SHARE, least >= LIMIT.INSIDE_LOOSE
    )
    how = uniform["outcome"][~settled(uniform)]
    ends = ", ".join(f"{end} ({n:,})" for end, n in how.value_counts().items() if n) or "in no other way"
    nearest = float(np.degrees(fails.min())) if len(fails) else math.nan
    return word, evidence(
        f"""Settled: {whole} of SO(3); inside the box {inside}, of the box set's inside starts {directed}; outside
        {outside}. The uniform ones that fail end {ends}. The nearest failure on a geodesic from the goal is at
        {nearest:.1f} degrees. {len(every) - len(sure)} of the starts do not converge.""",
        len(every) + len(fails),
    )


@claim("C07")
@on_every_engine
def c07(results: Results, engine: str) -> tuple[Word, Evidence]:
    """Outcome and peak command of episodes that come near the pole, against the rest."""
    frame = results.episodes(LAW, engine, "uniform")
    frame = frame[np.cos(frame["beta0"]) >= LIMIT.PASSING]
    near = frame["min_margin"] < LIMIT.PASSING
    passing, rest = some(frame[near], "episode that comes near the pole"), some(frame[~near], "other episode")
    lost_passing, lost_rest = lost(passing), lost(rest)
    peak, rest_peak = (
        quantile_estimate(some(converged(part), "episode that converges")["peak_u"].to_numpy(), 0.5)
        for part in (passing, rest)
    )
    ratio = peak.low / rest_peak.high
    is_extreme = lost_passing.low >= LIMIT.FAIL_EXTREME and lost_rest.high <= LIMIT.FAIL_REST
    is_raised = ratio >= LIMIT.PEAK_RAISED or lost_passing.low >= LIMIT.FAIL_RAISED * lost_rest.high
    word = word_of(ratio >= LIMIT.PEAK_EXTREME or is_extreme, is_raised)
    poles = results.episodes(LAW, engine, "poles")
    poles = poles[probes.boundary_distance(poles)["pole"] > probes.EXACT_RAD]
    beside = converged(poles)
    return word, evidence(
        f"""{len(passing)} episodes come within {math.degrees(math.asin(LIMIT.PASSING)):.1f} degrees of the pole; of the
        {len(converged(passing))} that converge {lost_passing.value:.2%} do not settle ({lost_passing.low:.2%} to
        {lost_passing.high:.2%}, the others settling or lost), against {interval(lost_rest, ".2%")} of the rest. Their
        median peak command is {peak.value:,.0f} rad/s^2 ({peak.low:,.0f} to {peak.high:,.0f}) against
        {interval(rest_peak, ",.0f")}. From rest beside the pole {settled_of(beside)} that converge settle, and
        {len(poles) - len(beside)} do not converge.""",
        len(frame) + len(poles),
    )


@claim("C08")
@on_every_engine
def c08(results: Results, engine: str) -> tuple[Word, Evidence]:
    """Far goals with E_d subtracted and with angles from the goal; near goals with E_d subtracted."""
    runs = ((LAW, "goals"), (CURE, "goals"), (CURE, "uniform"))
    base, cure, zero = (share(settled(results.episodes(law, engine, starts))) for law, starts in runs)
    starts = [Start("", IDENTITY, goal_wxyz=probes.about(axis, LIMIT.NEAR_GOAL_RAD)) for axis in axes(LIMIT.DIRECTIONS)]
    near = share(probes.episodes(LAW, starts, results.gains(), results.dt_s, SHORT)["outcome"] == "settled")
    works = cure.high >= zero.low - LIMIT.CURE_SLACK and cure.low > base.high
    word = word_of(works and base.high <= LIMIT.FEW_GOALS and not near.k, works and base.high < LIMIT.MANY_GOALS)
    return word, evidence(
        f"""With E_d subtracted it reaches {base} of the goals, and {near.k} of {near.n} goals {LIMIT.NEAR_GOAL_RAD} rad
        from zero; with angles from the goal {cure} of the goals, against {zero} of uniform starts with goal zero. By
        its eigenvalues it holds {held_goals.held_share(results.gains()):.1%} of all goals: those with alpha_d under
        {math.degrees(math.acos(held_goals.least_cosine(0.0, results.gains()))):.1f} degrees at beta_d = 0 and under 90
        at the poles, whatever gamma_d. As printed, u contains no goal.""",
        base.n + cure.n + zero.n + near.n,
    )


@claim("C29")
def c29(results: Results) -> tuple[Word, Evidence]:
    """Small rotations at several gains, then larger ones at the run's."""

    def off(angle: float, gains: Gains) -> float:
        return float(probes.off_linear(LAW, angle, axes(LIMIT.DIRECTIONS), gains, results.dt_s).max())

    small = np.array([[off(angle, Gains(*pair)) for angle in SMALL_ANGLES] for pair in GAINS])
    ticks = np.array([[results.dt_s / closed_form.linear_settling(*pair)] for pair in GAINS])
    gains = results.gains()
    within = max((angle for angle in LIMIT.LARGER_RAD if off(angle, gains) <= LOOSE_SETTLING), default=0.0)
    by_angle = ", ".join(f"{most:.2%} at {a:g} rad" for a, most in zip(SMALL_ANGLES, small.max(axis=0), strict=True))
    is_tight, is_loose = (small <= SMALL_ANGLES + ticks).all(), (small <= LOOSE_SETTLING + ticks).all()
    return word_of(is_tight, is_loose), evidence(
        f"""{LIMIT.DIRECTIONS} axes at {len(GAINS)} pairs of gains: at most {by_angle} from the closed form
        ({closed_form.linear_settling(*gains):.4f} s at the run's gains). Every time is within {LOOSE_SETTLING:.0%}
        up to {within:g} rad of {", ".join(f"{angle:g}" for angle in LIMIT.LARGER_RAD)} tried.""",
        LIMIT.DIRECTIONS * (small.size + len(LIMIT.LARGER_RAD)),
    )
