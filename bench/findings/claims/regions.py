"""C36 to C39: over which orientations the paper's laws are adequate (Murphy 1988, abstract, 2.4 and 2.5)."""

from __future__ import annotations

import numpy as np

from bench.base.on_first_use import pd
from bench.findings.claims import adequacy, probes, tables
from bench.findings.claims.adequacy import THREE
from bench.findings.claims.at_gains import at_every_gain
from bench.findings.claims.linearized_euler import CURE, LAW
from bench.findings.claims.tables import MAIN_ENGINE, Results, evidence, share, some
from bench.findings.claims.verdict import Evidence, Word, claim, read_limits, word_of
from bench.findings.theory import closed_form

LIMIT = read_limits(__file__)


@claim("C36")
def c36(results: Results) -> tuple[Word, Evidence]:
    """Return which tests of performance each of the three lacks, exact boundary points included."""
    small, known = closed_form.linear_settling(*results.gains()), adequacy.of_three(results)
    three = some([one for one in adequacy.every(results, MAIN_ENGINE) if one.name in THREE], "law of the paper")
    lacks = {one.name: set(adequacy.missed(one, known, small, {})) & set(LIMIT.TESTS) for one in three}
    told = "; ".join(
        f"{one.name.partition('/')[0]} lacks {', '.join(sorted(lacks[one.name])) or 'nothing'} ({one.settled:.2%} of "
        f"{one.n:,} settle, {one.lost} of {one.directed} directed starts are lost, {one.lost_exact} on a boundary "
        f"itself, 99% settle in {one.pace.value:.2f} s)"
        for one in three
    )
    is_none = len(three) == len(THREE) and all(lacks.values())
    return word_of(is_none, False), evidence(f"{told}.", sum(one.rows for one in three))


def _beyond(results: Results) -> pd.DataFrame:
    """Return the linearized law's uniform starts from rest outside the linear region."""
    rows = results.episodes(LAW, MAIN_ENGINE, "uniform")
    return some(rows[rows["angle0_rad"] >= LIMIT.BEYOND_RAD], "start outside the linear region")


@claim("C37")
def c37(results: Results) -> tuple[Word, Evidence]:
    """Share of starts outside the linear region that settle within C35's time."""
    rows, small = _beyond(results), closed_form.linear_settling(*results.gains())
    good = share(pd.Series(tables.settling_times(rows) <= LIMIT.PACE * small))
    return word_of(good.high <= LIMIT.FEW, good.high <= 0.5), evidence(
        f"""Of the uniform starts at {LIMIT.BEYOND_RAD:g} rad or more {good} settle within
        {LIMIT.PACE * small:.3f} s, {LIMIT.PACE:g} times the time of a small error.""",
        len(rows),
    )


@claim("C38")
@at_every_gain
def c38(results: Results) -> tuple[Word, Evidence]:
    """Settling times and losses outside the linear region, against turns of one angle alone."""
    rows, gains = _beyond(results), results.gains()
    small = closed_form.linear_settling(*gains)
    off = np.abs(rows.loc[tables.settled(rows), "settling_time_s"].to_numpy() / small - 1)
    typical, unsettled = float(np.median(some(off, "start that settles"))), tables.lost(rows)
    alone = max(float(probes.off_linear(LAW, angle, np.eye(3), gains, results.dt_s).max()) for angle in LIMIT.ALONE_RAD)
    coupled = typical >= LIMIT.OFF and alone <= LIMIT.SAME + results.dt_s / small
    return word_of(coupled and unsettled.low > 0.0, coupled), evidence(
        f"""Of {len(rows):,} uniform starts at {LIMIT.BEYOND_RAD:g} rad or more {unsettled.value:.2%} are lost
        ({unsettled.low:.2%} to {unsettled.high:.2%}); the others settle {typical:.1%} off the linear time, in the
        median. Turns of one angle alone, up to {max(LIMIT.ALONE_RAD):g} rad, settle within {alone:.2%} of it.""",
        len(rows) + 3 * len(LIMIT.ALONE_RAD),
    )


@claim("C39")
def c39(results: Results) -> tuple[Word, Evidence]:
    """Errors under a moving goal from small starts, against the rotation-matrix law's."""
    goals = LIMIT.AXIS, LIMIT.STARTS, LIMIT.HORIZON_S, results.gains(), results.seed
    runs = [results.found_by(probes.perturbed, law, *goals) for law in (f"{CURE}/zyx-euler", THREE[0])]
    near = (one[(one["angle0_rad"] <= LIMIT.SMALL_RAD) & (one["level"] > 0)] for one in runs)
    own, other = (some(one, "small start under a moving goal") for one in near)
    both = own.merge(other, on=["level", "start_id"], suffixes=("", "_other"))
    ratio = (both["tail_max_rad"] / both["tail_max_rad_other"]).where(both["outcome"] == "settled", np.inf)
    by_speed = ratio.groupby(both["level"]).max()
    kept = [speed for speed, worst in by_speed.items() if worst <= LIMIT.AS_WELL]
    tails = own["tail_max_rad"].groupby(own["level"]).max()
    said = ", ".join(f"{tails[speed]:.1e} rad ({worst:.2f}) at {speed:g} rad/s" for speed, worst in by_speed.items())
    return word_of(len(kept) == len(by_speed), min(by_speed.index) in kept), evidence(
        f"""{both["start_id"].nunique()} starts within {LIMIT.SMALL_RAD:g} rad, goals that sway: greatest error once it
        follows, and greatest ratio to the rotation-matrix law's, {said}.""",
        len(both),
    )
