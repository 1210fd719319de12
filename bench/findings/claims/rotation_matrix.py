"""C01 to C05 and C32: stability, settling times, zeros and arithmetic of the rotation-matrix law (Murphy 1988, 2.4)."""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from bench.experiments.tables.statistics import bootstrap
from bench.findings.amounts import capitalize, count, count_of
from bench.findings.claims import probes
from bench.findings.claims.adequacy import CALLS
from bench.findings.claims.at_gains import on_every_engine
from bench.findings.claims.probes import at_boundary
from bench.findings.claims.tables import (
    MAIN_ENGINE,
    Results,
    evidence,
        named_interval,
    percent,
    percent_interval,
    settled,
    share,
    some,
)
from bench.findings.claims.verdict import Evidence, Word, claim, read_limits, word_of
from bench.findings.theory import closed_form
from bench.law.inputs import Gains
from bench.law.so3 import IDENTITY, Rotation, cross, from_quaternion
from tasks.haar import axes

LIMIT = read_limits(__file__)


LAW = "rotation-matrix"


SMALL_ANGLES = (0.1, 0.01, 0.001)
GAINS = ((100.0, 20.0), (25.0, 10.0), (400.0, 40.0), (100.0, 10.0), (100.0, 40.0))
"""Critically damped at 10, 5 and 20 rad/s; then damping ratios 1/2 and 2 at 10 rad/s."""

LOOSE_SETTLING = 0.05
GAINS_TRIED = ", ".join(f"({kp:g}, {kv:g})" for kp, kv in GAINS)


ZERO_ERROR = EPS = 2.0**-52
"""One rounding of an element of R."""


@claim("C01")
@on_every_engine
def c01(results: Results, engine: str) -> tuple[Word, Evidence]:
    """Outcomes and final energies of uniform, half-turn and tumbling starts."""
    frame = results.episodes(LAW, engine, "uniform", "half-turn", "tumbling")
    speed = (frame[list(probes.OMEGA)] ** 2).sum(axis=1)
    gained = np.cos(frame["angle0_rad"]) - np.cos(frame["final_angle_rad"]) - speed / (2 * frame["kp"])
    unstable = int((frame["outcome"].isin(LIMIT.BROKEN[:3]) | (gained > LIMIT.ENERGY_SLACK)).sum())
    uniform = share(settled(frame[frame["start_set"] == "uniform"]))
    left = frame[~settled(frame)]
    exactly = int((probes.boundary_distance(left)["half_turn"].abs() <= probes.EXACT_RAD).sum())
    is_stray = uniform.n - uniform.k <= LIMIT.STRAY_SHARE * uniform.n
    return word_of(not unstable and exactly == len(left), not unstable and is_stray), evidence(
        f"""{capitalize(count_of(unstable, len(frame), "episodes"))} diverge or end with more energy than at their
        start. The body does not settle from {count(len(left), "start")}. {capitalize(count_of(exactly, len(left),
        "starts"))} of this kind are exactly 180° from the goal. Of the uniform starts, {uniform} settle.""",
        len(frame),
        measured=f"""Of {uniform.n:,} uniform random starts, {percent_interval(uniform)} settle. Of all {len(frame):,}
        starts that we simulated with the rotation-matrix law, {unstable or "none"} diverge.""",
    )


@claim("C02")
def c02(results: Results) -> tuple[Word, Evidence]:
    """Small rotations at several gains, and the small steps of the run."""
    small = [(Gains(*pair), angle) for pair in GAINS for angle in SMALL_ANGLES]
    off = [probes.off_linear(LAW, angle, LIMIT.AXES, gains, results.dt_s) for gains, angle in small]
    allowed = [results.dt_s / closed_form.linear_settling(*gains) + angle**2 for gains, angle in small]
    steps = results.episodes(LAW, MAIN_ENGINE, "goals")
    steps = some(steps[steps["angle0_rad"].between(1e-3, 0.11)], "small step of the start set goals")
    closed = closed_form.linear_settling(*results.gains())
    off += [(steps["settling_time_s"] / closed - 1).abs().fillna(np.inf)]
    allowed += [steps["dt_s"] / closed + steps["angle0_rad"] ** 2]
    times = [closed_form.linear_settling(*pair) for pair in GAINS]
    largest, count = max(one.max() for one in off), sum(map(len, off))
    is_tight = all((one <= most).all() for one, most in zip(off, allowed, strict=True))
    return word_of(is_tight, largest <= LOOSE_SETTLING), evidence(
        f"""We made {count} simulations of small rotations, with {len(GAINS)} pairs of gains. The linear model gives
        settling times of {min(times):.3f} to {max(times):.3f} s ({closed_form.linear_settling(*Gains()):.4f} s at the
        paper's gains). The simulated settling times differ from those of the linear model by at most {percent(largest)}
        %.""",
        count,
        measured=f"""We chose {len(GAINS)} pairs of gains, for which the linear model gives settling times of
        {min(times):.2f} to {max(times):.2f} s. The simulated settling times of {count} small rotations differ from
        those of the linear model by at most {percent(largest)} %.""",
    )


@claim("C03")
@on_every_engine
def c03(results: Results, engine: str) -> tuple[Word, Evidence]:
    """Judge the settling time by angle, its slope towards 180°, and the exact 180° rotations."""
    uniform = results.episodes(LAW, engine, "uniform")
    sure = some(uniform[settled(uniform)], "uniform start that settles")
    growth = bootstrap(sure[["angle0_rad", "settling_time_s"]].to_numpy(float), _slope)
    turns = results.episodes(LAW, engine, "half-turn")
    short = probes.boundary_distance(turns)["half_turn"]
    decades = -np.log10(short.clip(lower=1e-17))
    low, high = LIMIT.SLOPE_DECADES
    fitted = some(turns[decades.between(low - 0.5, high + 0.5) & settled(turns)], "half-turn start that settles")
    slope = np.polyfit(decades[fitted.index], fitted["settling_time_s"], 1)[0]
    closed = closed_form.decade_slope(*results.gains())
    off = abs(slope / closed - 1)
    exact = some(turns[short <= probes.EXACT_RAD], "exact 180° rotation")
    stay = exact[~settled(exact)]
    slowest = turns.loc[short > probes.EXACT_RAD, "settling_time_s"].max()
    is_infinite = bool((np.abs(stay["final_angle_rad"] - np.pi) <= LIMIT.AT_HALF_TURN).any())
    grows = growth.low > 0.0
    return word_of(grows and off <= LIMIT.SLOPE_TIGHT and is_infinite, grows and off <= LIMIT.SLOPE_LOOSE), evidence(
        f"""For each rad of the initial angle, the settling time grows by
        {named_interval(growth, ".3f", " s")}. Close to 180°, the settling time grows by
        {float(slope):.4f} s each time the distance from 180° becomes ten times smaller. The closed form of this growth
        is {closed:.4f} s. At 1e-12 rad from 180°, the settling time is {float(slowest):.2f} s.
        {capitalize(count_of(len(exact) - len(stay), len(exact), "starts"))} at exactly 180° settle within
        {float(exact["horizon_s"].min()):g} s.""",
        len(uniform) + len(turns),
        measured=f"""If the initial angle is larger by 1 rad, the settling time is longer by
        {named_interval(growth, ".3f", " s")} on average.
        {capitalize(count_of(len(exact) - len(stay), len(exact), "starts"))} at exactly 180° settle.""",
    )


def _slope(pairs: np.ndarray, axis: Sequence[float] | np.ndarray) -> Any:
    """Least-squares slope of the second of each pair against the first."""
    from_mean = pairs - pairs.mean(axis=-2, keepdims=True)
    with np.errstate(invalid="ignore"):  # one start has no slope
        return (from_mean[..., 0] * from_mean[..., 1]).sum(axis=-1) / (from_mean[..., 0] ** 2).sum(axis=-1)


@claim("C04")
@on_every_engine
def c04(results: Results, engine: str) -> tuple[Word, Evidence]:
    """Judge the error and its three cross products at exact 180° rotations, and how the episodes end."""
    exact = at_boundary(results.episodes(LAW, engine, "half-turn"), "half_turn", "exact 180° rotation")
    orientations = probes.rotations(exact)
    largest = max(_size(R) for R in orientations)
    products = [_largest_product(R) for R in orientations]
    parallel = sum(product <= ZERO_ERROR for product in products)
    is_zero = largest <= ZERO_ERROR
    return word_of(is_zero and parallel == len(exact), is_zero), evidence(
        f"""We tested {len(exact)} exact 180° rotations. The largest length |e| of the error at these rotations is
        {largest:.1g}. The body settles from {count_of(int(settled(exact).sum()), len(exact), "rotations")}. At
        {parallel} rotations (about x, y and z), each of the three cross products is zero. At the other
        {len(exact) - parallel} rotations, only the sum of the three products is zero. The longest of all these products
        has the length {max(products):.2f}.""",
        len(exact),
        measured=f"""The error of the rotation-matrix law is half the sum of three cross products. At {len(exact)} exact
        180° rotations, the largest length of this error is {largest:.1g}. At {parallel} of these rotations (about x, y
        and z), each of the three products is zero.""",
    )


@claim("C05")
def c05(results: Results) -> tuple[Word, Evidence]:
    """|e| over sin(angle), at every start of the run and as low as a search gets; what cancels at 180° rotations."""
    from scipy.optimize import minimize

    frame = results.episodes(LAW, MAIN_ENGINE).drop_duplicates(["start_set", "start_id"])
    frame = some(
        frame[frame["angle0_rad"].between(LIMIT.AWAY_RAD, np.pi - LIMIT.AWAY_RAD)], "start away from 0 and 180°"
    )
    sizes = np.array([_size(*pair) for pair in _pairs(frame)])
    found = [minimize(_ratio, 1.5 * axis, method="Nelder-Mead", options={"maxiter": 200}) for axis in axes(16)]
    states = sum(one.nfev for one in found)
    lowest = min(float((sizes / np.sin(frame["angle0_rad"])).min()), *(one.fun for one in found))
    least = min(float(sizes.min()), *(_size(_turn(one.x)) for one in found))
    exact = at_boundary(results.episodes(LAW, MAIN_ENGINE, "half-turn"), "half_turn", "exact 180° rotation")
    cancel = sum(_size(R) <= ZERO_ERROR < _largest_product(R) for R in probes.rotations(exact))
    readings = (least < LIMIT.NEAR_ZERO, cancel > 0)
    return word_of(all(readings), any(readings)), evidence(
        f"""The paper's sentence has two possible meanings. Meaning (a): the error e is zero at some orientation away
        from 180°. We computed |e| at {len(frame):,} starts and at {states:,} orientations of a search, which are all
        away from 180°. At these orientations, |e| / sin(angle) is at least {lowest:.9f}, and |e| is at least
        {least:.1e}. Meaning (b): at an exact 180° rotation, the sum of the three cross products is zero, but one of the
        products is not zero. We tested {len(exact)} exact 180° rotations. At {cancel} of these rotations, the sum of
        the three cross products is zero, but not all of the products are zero.""",
        len(frame) + states + len(exact),
        measured=f"""At {cancel} of {len(exact)} exact 180° rotations, the sum of the three cross products is zero, but
        not all of the products are zero. Away from 180°, the length |e| of the error is at least {lowest:.4f} times the
        sine of the rotation angle.""",
    )


def error(R: Rotation, R_d: Rotation = IDENTITY) -> np.ndarray:
    """e of (2.12): the law's command at rest over Kp."""
    return probes.command(LAW, R, R_d=R_d) / Gains().kp


def _size(R: Rotation, R_d: Rotation = IDENTITY) -> float:
    return float(np.linalg.norm(error(R, R_d)))


def _largest_product(R: Rotation) -> float:
    """Return the largest of the three cross products of (2.12), goal zero."""
    return float(max(np.linalg.norm(cross(c, d)) for c, d in zip(R, IDENTITY, strict=True)))


def _turn(vector: Sequence[float]) -> Rotation:
    """R of a rotation vector."""
    return from_quaternion(probes.about(vector, float(np.linalg.norm(vector))))


def _ratio(vector: Sequence[float]) -> float:
    angle = float(np.linalg.norm(vector))
    if not LIMIT.AWAY_RAD < angle < np.pi - LIMIT.AWAY_RAD:
        return 2.0  # out of bounds: more than any ratio
    return _size(_turn(vector)) / np.sin(angle)


def _pairs(frame: Any) -> list[tuple[Rotation, Rotation]]:
    """R and R_d of each start."""
    return list(zip(probes.rotations(frame), probes.rotations(frame, probes.GOAL_QUAT), strict=True))


@claim("C32")
def c32(results: Results) -> tuple[Word, Evidence]:
    """Judge the rounding of e against exact fractions, the parts of the law, and how its episodes end."""
    results.episodes(LAW, MAIN_ENGINE)  # refuses a run that lacks starts
    every = results.free_body("episodes", task="free-body", regulator=LAW)
    ended = int(every["outcome"].isin(LIMIT.BROKEN).sum())
    frame = every.drop_duplicates(["start_set", "start_id"])
    ours = np.array([error(*pair) for pair in _pairs(frame)])
    exact = np.array([_exact(*pair) for pair in _pairs(frame)])
    off = np.abs(np.vectorize(Fraction, otypes=[object])(ours) - exact).max(axis=1).astype(float)
    angle = frame["angle0_rad"].to_numpy()
    inner = np.minimum(angle, np.pi - angle) >= LIMIT.CLOSEST_RAD * (1 - LIMIT.DIGITS)
    relative = (off / np.linalg.norm(ours, axis=1).clip(min=EPS))[inner]
    costs = some(results.free_body("costs", regulator=LAW), f"cost of {LAW}")
    asked = int(costs[["div", *CALLS]].to_numpy().sum())
    sound = bool(np.isfinite(ours).all() and off.max() <= LIMIT.ROUNDINGS * EPS and not asked and not ended)
    broken = ", ".join(f"'{outcome}'" for outcome in LIMIT.BROKEN[:-1])
    return word_of(sound and relative.max() <= LIMIT.DIGITS, sound), evidence(
        f"""At {len(frame):,} starts, the rounding error of the orientation error e is at most {off.max() / EPS:.1f}
        eps (eps = 2.2e-16). Away from the goal and from 180° rotations, the rounding error is at most
        {relative.max():.1e} times the length of e. The rotation-matrix law contains {asked or "no"} divisions or
        calls of functions. {capitalize(count_of(ended, len(every), "episodes"))} with this law end with the outcome
        {broken} or '{LIMIT.BROKEN[-1]}'.""",
        len(every) + len(costs),
        measured=f"""We computed the orientation error e at {len(frame):,} starts. Away from the goal
        and from 180° rotations, rounding changes e by at most {relative.max():.1e} times the length
        of e. The rotation-matrix law needs {asked or "no"} divisions.""",
    )


def _exact(R: Rotation, R_d: Rotation) -> list[Fraction]:
    """e of (2.12) of the same doubles, without rounding."""
    columns = [([Fraction(x) for x in c], [Fraction(x) for x in d]) for c, d in zip(R, R_d, strict=True)]
    return [sum((c[i - 2] * d[i - 1] - c[i - 1] * d[i - 2] for c, d in columns), Fraction(0)) / 2 for i in range(3)]
