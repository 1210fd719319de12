"""C01 to C03: stability and settling time of the rotation-matrix law (Murphy 1988, 2.12-2.13 and 2.4)."""

import numpy as np

from bench.findings.claims import probes
from bench.findings.claims.tables import MAIN_ENGINE, evidence, on_every_engine, settled, share, some
from bench.findings.claims.verdict import Earlier, Word, claim, word_of
from bench.findings.theory import closed_form
from bench.law.contender import Gains
from bench.tables.statistics import bootstrap
from tasks.base import Start

LAW = "rotation-matrix"
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

AT_HALF_TURN = 1e-6
"""rad: what leaves an equilibrium has left it by more within its horizon."""


@claim(
    id="C01",
    section="2.4",
    equation="(2.12), (2.13)",
    quote="""
        The results of the simulation show that this regulator was stable over the entire range of rotations but
        had varying settling times for different initial orientations.
    """,
    written="2026-11-23 953f62a",
    sentence="The rotation-matrix regulator is stable over the entire range of rotations.",
    question="Does any start diverge; and does every start reach the goal?",
    criterion=f"""
        Start sets uniform, half-turn and tumbling. Stable (Lyapunov) means: no episode ends diverged, singular or
        saturated, and none ends beyond its initial energy, 1 - cos(angle_end) <= 1 - cos(angle_0) + |omega_0|^2 / (2
        Kp) + {ENERGY_SLACK:g}. It holds if that is so and every start that does not settle is on a 180° rotation to
        {probes.EXACT_RAD:g} rad, where the paper itself lets the settling time be infinite; with a correction if it is
        stable but other starts do not settle, at most {STRAY_SHARE:.1%} of the uniform ones; otherwise it does not
        hold.
    """,
    open="""
        The paper gives no gains for this law (ours are those of the other two), no starts and no horizon;
        a start that has not settled at the horizon counts as not settled. The energy bound is free of all
        three.
    """,
    readings=(
        "stable: nothing diverges (the one judged)",
        "attracted: every start reaches the goal, but those of which the paper's next sentences say that they do not",
    ),
    correction="It is stable, but other starts than 180° rotations are not attracted.",
    earlier=(
        Earlier(
            "2026-11-21 9072535",
            """
            A start that does not settle made a correction, wherever it was; but the paper says itself that settling
            times can become infinite at certain orientations.
            """,
            Word.CORRECTED,
        ),
    ),
)
@on_every_engine
def c01(results, engine):
    """Outcomes and final energies of uniform, half-turn and tumbling starts."""
    frame = results.episodes(LAW, engine, "uniform", "half-turn", "tumbling")
    broken = frame["outcome"].isin(["diverged", "singular", "saturated"])
    speed = (frame[list(probes.OMEGA)] ** 2).sum(axis=1)
    gained = np.cos(frame["angle0_rad"]) - np.cos(frame["final_angle_rad"]) - speed / (2 * frame["kp"])
    unstable = broken | (gained > ENERGY_SLACK)
    uniform = share(settled(frame[frame["start_set"] == "uniform"]))
    left = frame[~settled(frame)]
    away = probes.boundary_distance(left)["half_turn"].abs() if len(left) else np.zeros(0)
    elsewhere = int((away > probes.EXACT_RAD).sum())
    is_stable = not unstable.any()
    word = word_of(is_stable and not elsewhere, is_stable and uniform.n - uniform.k <= STRAY_SHARE * uniform.n)
    return word, evidence(
        f"""{int(unstable.sum())} of {len(frame):,} starts diverge or gain energy. {len(left)} do not settle,
        {len(left) - elsewhere} of them exactly a 180° rotation from the goal; of uniform starts {uniform}
        settle.""",
        len(frame),
        ("episodes",),
    )


@claim(
    id="C02",
    section="2.4",
    quote="""
        In the linear region of small rotations about zero, the settling times could be chosen from the feedback
        gains.
    """,
    correction="They follow the closed form of the gains, but only to a few per cent.",
    written="2026-11-21 9072535",
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
def c02(results):
    """Small rotations at several gains, and the small steps of the run."""
    axes = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1), "diagonal": (1, 1, 1)}
    pairs = [(angle, axis) for angle in SMALL_ANGLES for axis in axes.values()]
    starts = [Start("", probes.about(axis, angle)) for angle, axis in pairs]
    angles = np.array([angle for angle, _ in pairs])
    dt, off, share_off, longest = results.dt_s, [], [], {}
    for gains in (Gains(*pair) for pair in GAINS):
        closed = closed_form.linear_settling(*gains)
        found = probes.episodes(LAW, starts, gains, dt, 20.0)["settling_time_s"].to_numpy()
        off += list(np.abs(found - closed) - dt - angles**2 * closed)
        share_off += list(np.abs(found - closed) / closed)
        longest[gains] = closed
    steps = results.episodes(LAW, MAIN_ENGINE, "goals")
    steps = some(steps[steps["angle0_rad"].between(1e-3, 0.11)], "small step of the start set goals")
    closed = closed_form.linear_settling(*results.gains())
    wrong = (steps["settling_time_s"] - closed).abs()
    off += list(wrong - steps["dt_s"] - steps["angle0_rad"] ** 2 * closed)
    share_off += list(wrong / closed)
    tight, loose = np.max(off) <= 0, np.max(share_off) <= LOOSE_SETTLING
    return (word_of(tight, loose)), evidence(
        f"""{len(off)} small rotations at {len(GAINS)} pairs of gains: settling times from {min(longest.values()):.3f}
        to {max(longest.values()):.3f} s, at most {float(np.max(share_off)):.2%} from the closed form
        ({closed_form.linear_settling(*Gains()):.4f} s at the paper's gains).""",
        len(off),
        ("experiment", "episodes"),
    )


@claim(
    id="C03",
    section="2.4",
    quote="For large rotations the settling times would increase and could become infinity at certain orientations.",
    correction="They grow as the closed form has it, but not to infinity, or not exactly so.",
    written="2026-11-24 fb18d38",
    sentence="For large rotations the settling time grows, and it can become infinite.",
    question="Does it grow with the angle, at which rate towards the half turn, and is it ever infinite?",
    criterion=f"""
        Three tests. Growth: the least-squares slope of settling time against the initial angle, of uniform starts that
        settle, is above zero by the lower end of its 95 % interval (bootstrap). Rate: least squares over the set
        half-turn, pi - angle = 10^-k, k = {SLOPE_DECADES[0]} to {SLOPE_DECADES[1]}, gives a slope per decade within
        {SLOPE_TIGHT:.0%} of ln 10 / (sqrt(Kp + Kd^2/4) - Kd/2). Infinity: at least one exact half turn
        has not settled at its horizon and is then still at pi, to {AT_HALF_TURN:g} rad: it is at an equilibrium. It
        holds if all three pass; with a correction if growth passes and the slope is
        within {SLOPE_LOOSE:.0%}, whatever infinity says; otherwise it does not hold.
    """,
    open="""
        The slope depends on the gains, which enter the formula. The paper gives none for this law.
    """,
    earlier=(
        Earlier(
            "2026-11-21 9072535",
            """
            Growth was a mean that rises from each 30 degree bin to the next, and infinity a horizon of more than twice
            the longest settling time. At other gains the least bin or the horizon decided, not the law: with Kv = 10
            the first two bins fall, with Kv = 30 the horizon is too short.
            """,
            Word.HOLDS,
        ),
    ),
)
@on_every_engine
def c03(results, engine):
    """Settling time by angle, its slope towards the half turn, and the exact half turns."""
    uniform = results.episodes(LAW, engine, "uniform")
    sure = some(uniform[settled(uniform)], "uniform start that settles")
    growth = bootstrap(sure[["angle0_rad", "settling_time_s"]].to_numpy(float), _slope)
    grows = growth.low > 0.0
    turns = results.episodes(LAW, engine, "half-turn")
    short = probes.boundary_distance(turns)["half_turn"]
    decades = -np.log10(short.clip(lower=1e-17))
    low, high = SLOPE_DECADES
    fitted = some(turns[decades.between(low - 0.5, high + 0.5) & settled(turns)], "half-turn start that settles")
    slope = np.polyfit(decades[fitted.index], fitted["settling_time_s"], 1)[0]
    closed = closed_form.decade_slope(*results.gains())
    off = abs(slope / closed - 1)
    exact = some(turns[short <= probes.EXACT_RAD], "exact half turn")
    stay = exact[~settled(exact)]
    slowest = turns.loc[short > probes.EXACT_RAD, "settling_time_s"].max()
    infinite = bool((np.abs(stay["final_angle_rad"] - np.pi) <= AT_HALF_TURN).any())
    held = grows and off <= SLOPE_TIGHT and infinite
    word = word_of(held, grows and off <= SLOPE_LOOSE)
    return word, evidence(
        f"""Settling time rises by {growth.value:.3f} s ({growth.low:.3f} to {growth.high:.3f}) per rad of the initial
        angle; towards the half turn by {float(slope):.4f} s a decade (closed form {closed:.4f} s), to
        {float(slowest):.2f} s at 1e-12 rad. {len(stay)} of {len(exact)} exact half turns never settle in
        {float(exact["horizon_s"].min()):g} s.""",
        len(uniform) + len(turns),
        ("episodes",),
    )


def _slope(pairs, axis):
    """Least-squares slope of the second of each pair against the first."""
    from_mean = pairs - pairs.mean(axis=-2, keepdims=True)
    return (from_mean[..., 0] * from_mean[..., 1]).sum(axis=-1) / (from_mean[..., 0] ** 2).sum(axis=-1)
