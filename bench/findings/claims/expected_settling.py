"""C29: settling times of the linearized Euler law near zero (Murphy 1988, 2.14 and 2.4)."""

import numpy as np

from bench.findings.claims import probes
from bench.findings.claims.rotation_matrix import GAINS, GAINS_TRIED, LOOSE_SETTLING, SMALL_ANGLES
from bench.findings.claims.tables import evidence
from bench.findings.claims.verdict import claim, word_of
from bench.findings.theory import closed_form
from bench.law.contender import Gains
from tasks.base import Start
from tasks.sphere import axes

LAW = "linearized-euler/zyx-euler"
DIRECTIONS = 16
LARGER_RAD = (0.2, 0.4, 0.6, 0.8, 1.0, 1.2)


@claim(
    id="C29",
    section="2.4",
    quote="""
        In small regions about the zero Euler angle point, the system was stable with the expected settling times.
    """,
    correction="Settling times are those expected only to a few per cent, however small the region.",
    written="2026-11-23 bc126c2",
    sentence="Near zero the linearized law is stable with the settling times of its linear model.",
    question="Is the settling time of small rotations the closed form of the linear system, at every pair of gains?",
    criterion=f"""
        Rotations of 0.1, 0.01 and 0.001 rad about {DIRECTIONS} axes all over the sphere, at (Kp, Kd) = {GAINS_TRIED};
        the closed form is that of C02. It holds if every one settles, its time within one tick plus angle times the
        closed form of it, for what is left out of the model is of first order in the angle; with a correction if within
        {LOOSE_SETTLING:.0%} plus one tick; otherwise it does not hold. Reported: up to which angle every time is within
        {LOOSE_SETTLING:.0%}.
    """,
    open="'Small' has no number; the judge's band of 2 % is the closed form's too.",
)
def c29(results):
    """Small rotations at several gains, then larger ones at the run's."""
    off, whole = (
        np.array([_off(angle, Gains(*pair), results.dt_s) for pair in GAINS for angle in SMALL_ANGLES]),
        len(SMALL_ANGLES),
    )
    allowed = np.tile(SMALL_ANGLES, len(GAINS))
    ticks = np.repeat([results.dt_s / closed_form.linear_settling(*pair) for pair in GAINS], whole)
    word = word_of((off <= allowed + ticks).all(), (off <= LOOSE_SETTLING + ticks).all())
    gains = results.gains()
    larger = {angle: _off(angle, gains, results.dt_s) for angle in LARGER_RAD}
    within = max((angle for angle, one in larger.items() if one <= LOOSE_SETTLING), default=0.0)
    by_angle = ", ".join(f"{off.reshape(-1, whole)[:, k].max():.2%} at {a:g} rad" for k, a in enumerate(SMALL_ANGLES))
    return word, evidence(
        f"""{DIRECTIONS} axes at {len(GAINS)} pairs of gains: at most {by_angle} from the closed form
        ({closed_form.linear_settling(*gains):.4f} s at the run's gains). Every time is within {LOOSE_SETTLING:.0%}
        up to {within:g} rad of {", ".join(f"{angle:g}" for angle in LARGER_RAD)} tried.""",
        DIRECTIONS * (len(off) + len(larger)),
        ("experiment",),
    )


def _off(angle: float, gains: Gains, dt_s: float) -> float:
    """The farthest settling time of rotations by an angle from the closed form, relatively; infinite if one fails."""
    starts = [Start("", probes.about(axis, angle)) for axis in axes(DIRECTIONS)]
    closed = closed_form.linear_settling(*gains)
    times = probes.episodes(LAW, starts, gains, dt_s, 20.0)["settling_time_s"]
    return float(np.nan_to_num(np.abs(times / closed - 1), nan=np.inf).max())
