"""C01 to C05 and C32: stability, settling times, zeros and arithmetic of the rotation-matrix law (Murphy 1988, 2.4)."""

from __future__ import annotations

from typing import Any

import numpy as np

from bench.base.on_first_use import pd
from bench.experiments.probe_values.turns import GAINS
from bench.experiments.tables.run import MAIN_ENGINE, Run, require_rows
from bench.experiments.tables.statistics import Estimate, percentile_estimate, resampled_slope
from bench.findings.amounts import capitalize, count, count_of
from bench.findings.claims import places
from bench.findings.claims.adequacy import CALLS
from bench.findings.claims.at_gains import on_every_engine
from bench.findings.claims.places import EXACT_RAD, at_boundary
from bench.findings.claims.tables import (
    episodes_of,
    evidence,
    named_interval,
    percent,
    percent_interval,
    settled,
    settling_times,
    share,
)
from bench.findings.claims.verdict import Evidence, Word, claim, word_of
from bench.findings.theory import closed_form
from bench.law.inputs import Gains

# Above one uniform start in 1,000 the starts that do not settle are no longer isolated orientations.
STRAY_SHARE = 1e-3
# rad^2/s^2 over Kp: rounding and integration of an energy that never grows; the largest is 2.
ENERGY_SLACK = 1e-6
# Below 3 the sine is not yet linear in pi - angle; beyond 10, rounding of R (1e-16) exceeds 1e-6 of it.
SLOPE_DECADES = (3, 10)
SLOPE_TIGHT = 0.01
SLOPE_LOOSE = 0.1
# rad: what leaves an equilibrium has left it by more within its horizon.
AT_HALF_TURN = 1e-6
AWAY_RAD = 1e-3
NEAR_ZERO = 1e-9
# Each element of e sums six products of numbers up to 1: eleven roundings of half an eps, of partial sums up to 3.
ROUNDINGS = 10.0
# To the goal and to a 180° rotation; and what rounding may make of the error's length there.
CLOSEST_RAD = 1e-12
DIGITS = 1e-2
BROKEN = ("diverged", "singular", "saturated", "crashed")


LAW = "rotation-matrix"


LOOSE_SETTLING = 0.05
GAINS_TRIED = ", ".join(f"({kp:g}, {kv:g})" for kp, kv in GAINS)


ZERO_ERROR = EPS = 2.0**-52
"""One rounding of an element of R."""


@claim("C01")
@on_every_engine
def c01(run: Run, engine: str) -> tuple[Word, Evidence]:
    """Outcomes and final energies of uniform, half-turn and tumbling starts."""
    frame = episodes_of(run, LAW, engine, "uniform", "half-turn", "tumbling")
    speed = (frame[list(places.OMEGA)] ** 2).sum(axis=1)
    gained = np.cos(frame["angle0_rad"]) - np.cos(frame["final_angle_rad"]) - speed / (2 * frame["kp"])
    unstable = int((frame["outcome"].isin(BROKEN[:3]) | (gained > ENERGY_SLACK)).sum())
    uniform = share(settled(frame[frame["start_set"] == "uniform"]))
    left = frame[~settled(frame)]
    exactly = int((places.boundary_distance(left)["half_turn"].abs() <= EXACT_RAD).sum())
    is_stray = uniform.n - uniform.k <= STRAY_SHARE * uniform.n
    return word_of(not unstable and exactly == len(left), not unstable and is_stray), evidence(
        f"""{capitalize(count_of(unstable, len(frame), "episodes"))} diverge or end with more energy than at their
        start. The body does not settle from {count(len(left), "start")}. {capitalize(count_of(exactly, len(left),
        "starts"))} of this kind are exactly 180° from the goal. Of the uniform starts, {uniform} settle.""",
        len(frame),
        measured=f"""Of {uniform.n:,} uniform random starts, {percent_interval(uniform)} settle. Of all {len(frame):,}
        starts that we simulated with the rotation-matrix law, {unstable or "none"} diverge.""",
    )


@claim("C02")
def c02(run: Run) -> tuple[Word, Evidence]:
    """Small rotations at several gains, and the small steps of the run."""
    small, period_s = run.probe("small-turn", regulator=LAW), run.period()
    each_closed = [closed_form.linear_settling(*gains) for gains in zip(small["kp"], small["kv"], strict=True)]
    off = [off_linear(small, each_closed)]
    allowed = [period_s / np.array(each_closed) + small["at"].to_numpy() ** 2]
    steps = episodes_of(run, LAW, MAIN_ENGINE, "goals")
    is_small = steps["angle0_rad"].between(1e-3, 0.11)
    steps = require_rows(steps[is_small], "small step of the start set goals")
    closed = closed_form.linear_settling(*run.gains())
    off += [(steps["settling_time_s"] / closed - 1).abs().fillna(np.inf)]
    allowed += [steps["dt_s"] / closed + steps["angle0_rad"] ** 2]
    pairs = small[["kp", "kv"]].drop_duplicates()
    times = [closed_form.linear_settling(*pair) for pair in pairs.itertuples(index=False)]
    largest, count = max(one.max() for one in off), sum(map(len, off))
    is_tight = all((one <= most).all() for one, most in zip(off, allowed, strict=True))
    return word_of(is_tight, largest <= LOOSE_SETTLING), evidence(
        f"""We made {count} simulations of small rotations, with {len(pairs)} pairs of gains. The linear model gives
        settling times of {min(times):.3f} to {max(times):.3f} s ({closed_form.linear_settling(*Gains()):.4f} s at the
        paper's gains). The simulated settling times differ from those of the linear model by at most {percent(largest)}
        %.""",
        count,
        measured=f"""We chose {len(pairs)} pairs of gains, for which the linear model gives settling times of
        {min(times):.2f} to {max(times):.2f} s. The simulated settling times of {count} small rotations differ from
        those of the linear model by at most {percent(largest)} %.""",
    )


def off_linear(turns: pd.DataFrame, closed_s: Any) -> np.ndarray:
    """Return how far settling times are from the linear closed form, relatively; infinite where one does not settle."""
    times = settling_times(turns)
    return np.abs(times / np.asarray(closed_s) - 1)


@claim("C03")
@on_every_engine
def c03(run: Run, engine: str) -> tuple[Word, Evidence]:
    """Judge the settling time by angle, its slope towards 180°, and the exact 180° rotations."""
    uniform = episodes_of(run, LAW, engine, "uniform")
    sure = require_rows(uniform[settled(uniform)], "uniform start that settles")
    growth = _slope(sure["angle0_rad"].to_numpy(float), sure["settling_time_s"].to_numpy(float))
    turns = episodes_of(run, LAW, engine, "half-turn")
    short = places.boundary_distance(turns)["half_turn"]
    decades = -np.log10(short.clip(lower=1e-17))
    low, high = SLOPE_DECADES
    is_fitted = decades.between(low - 0.5, high + 0.5) & settled(turns)
    fitted = require_rows(turns[is_fitted], "half-turn start that settles")
    slope = np.polyfit(decades[fitted.index], fitted["settling_time_s"], 1)[0]
    closed = closed_form.decade_slope(*run.gains())
    off = abs(slope / closed - 1)
    exact = require_rows(turns[short <= EXACT_RAD], "exact 180° rotation")
    stay = exact[~settled(exact)]
    slowest = turns.loc[short > EXACT_RAD, "settling_time_s"].max()
    is_infinite = bool((np.abs(stay["final_angle_rad"] - np.pi) <= AT_HALF_TURN).any())
    grows = growth.low > 0.0
    return word_of(grows and off <= SLOPE_TIGHT and is_infinite, grows and off <= SLOPE_LOOSE), evidence(
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


def _slope(x: np.ndarray, y: np.ndarray) -> Estimate:
    """Return the least-squares slope of y against x, resampled by starts."""
    from_mean = x - x.mean()
    with np.errstate(invalid="ignore"):  # one start has no slope
        value = (from_mean * (y - y.mean())).sum() / (from_mean**2).sum()
    return percentile_estimate(value, resampled_slope(x, y))


@claim("C04")
@on_every_engine
def c04(run: Run, engine: str) -> tuple[Word, Evidence]:
    """Judge the error and its three cross products at exact 180° rotations, and how the episodes end."""
    exact = at_boundary(episodes_of(run, LAW, engine, "half-turn"), "half_turn", "exact 180° rotation")
    errors = errors_at(run, exact)
    largest, products = float(errors["error"].max()), errors["largest_product"]
    parallel = int((products <= ZERO_ERROR).sum())
    is_zero = largest <= ZERO_ERROR
    return word_of(is_zero and parallel == len(exact), is_zero), evidence(
        f"""We tested {len(exact)} exact 180° rotations. The largest length |e| of the error at these rotations is
        {largest:.1g}. The body settles from {count_of(int(settled(exact).sum()), len(exact), "rotations")}. At
        {parallel} rotations (about x, y and z), each of the three cross products is zero. At the other
        {len(exact) - parallel} rotations, only the sum of the three products is zero. The longest of all these products
        has the length {products.max():.2f}.""",
        len(exact),
        measured=f"""The error of the rotation-matrix law is half the sum of three cross products. At {len(exact)} exact
        180° rotations, the largest length of this error is {largest:.1g}. At {parallel} of these rotations (about x, y
        and z), each of the three products is zero.""",
    )


@claim("C05")
def c05(run: Run) -> tuple[Word, Evidence]:
    """|e| over sin(angle), at every start of the run and as low as a search gets; what cancels at 180° rotations."""
    every = episodes_of(run, LAW, MAIN_ENGINE)  # refuses a run that lacks starts
    errors = errors_at(run, every)
    is_away = errors["at"].between(AWAY_RAD, np.pi - AWAY_RAD)
    away = require_rows(errors[is_away], "start away from 0 and 180°")
    search = run.probe("error-search")
    states = int(search["evaluations"].sum())
    ratios = away["error"] / np.sin(away["at"])
    lowest = min(float(ratios.min()), float(search["least_ratio"].min()))
    least = min(float(away["error"].min()), float(search["error"].min()))
    half_turns = episodes_of(run, LAW, MAIN_ENGINE, "half-turn")
    exact = errors_at(run, at_boundary(half_turns, "half_turn", "exact 180° rotation"))
    cancel = int(((exact["error"] <= ZERO_ERROR) & (exact["largest_product"] > ZERO_ERROR)).sum())
    readings = (least < NEAR_ZERO, cancel > 0)
    return word_of(all(readings), any(readings)), evidence(
        f"""The paper's sentence has two possible meanings. Meaning (a): the error e is zero at some orientation away
        from 180°. We computed |e| at {len(away):,} starts and at {states:,} orientations of a search, which are all
        away from 180°. At these orientations, |e| / sin(angle) is at least {lowest:.9f}, and |e| is at least
        {least:.1e}. Meaning (b): at an exact 180° rotation, the sum of the three cross products is zero, but one of the
        products is not zero. We tested {len(exact)} exact 180° rotations. At {cancel} of these rotations, the sum of
        the three cross products is zero, but not all of the products are zero.""",
        len(away) + states + len(exact),
        measured=f"""At {cancel} of {len(exact)} exact 180° rotations, the sum of the three cross products is zero, but
        not all of the products are zero. Away from 180°, the length |e| of the error is at least {lowest:.4f} times the
        sine of the rotation angle.""",
    )


def errors_at(run: Run, frame: pd.DataFrame) -> pd.DataFrame:
    """Return what the probe `error` has of the starts of some episodes, a row a start."""
    errors = run.probe("error")
    return require_rows(errors[errors["case"].isin(set(frame["start_id"]))], "start of the probe 'error'")


@claim("C32")
def c32(run: Run) -> tuple[Word, Evidence]:
    """Judge the rounding of e against exact fractions, the parts of the law, and how its episodes end."""
    episodes_of(run, LAW, MAIN_ENGINE)  # refuses a run that lacks starts
    every = run.free_body("episodes", task="free-body", regulator=LAW)
    ended = int(every["outcome"].isin(BROKEN).sum())
    errors = errors_at(run, every)
    off = errors["rounding_gap"]
    inner = np.minimum(errors["at"], np.pi - errors["at"]) >= CLOSEST_RAD * (1 - DIGITS)
    relative = (off / errors["error"].clip(lower=EPS))[inner]
    costs = require_rows(run.free_body("costs", regulator=LAW), f"cost of {LAW}")
    asked = int(costs[["div", *CALLS]].to_numpy().sum())
    sound = bool(np.isfinite(errors["error"]).all() and off.max() <= ROUNDINGS * EPS and not asked and not ended)
    broken = ", ".join(f"'{outcome}'" for outcome in BROKEN[:-1])
    return word_of(sound and relative.max() <= DIGITS, sound), evidence(
        f"""At {len(errors):,} starts, the rounding error of the orientation error e is at most {off.max() / EPS:.1f}
        eps (eps = 2.2e-16). Away from the goal and from 180° rotations, the rounding error is at most
        {relative.max():.1e} times the length of e. The rotation-matrix law contains {asked or "no"} divisions or
        calls of functions. {capitalize(count_of(ended, len(every), "episodes"))} with this law end with the outcome
        {broken} or '{BROKEN[-1]}'.""",
        len(every) + len(costs),
        measured=f"""We computed the orientation error e at {len(errors):,} starts. Away from the goal
        and from 180° rotations, rounding changes e by at most {relative.max():.1e} times the length
        of e. The rotation-matrix law needs {asked or "no"} divisions.""",
    )
