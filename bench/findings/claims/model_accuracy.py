"""C30: what an error of the model does to feedback linearization (Murphy 1988, 2.4)."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING

from bench.findings.claims.adequacy import THREE
from bench.findings.claims.tables import evidence, settled, share
from bench.findings.claims.verdict import Earlier, Word, claim, word_of
from bench.findings.theory import closed_form
from bench.law.contender import Gains

if TYPE_CHECKING:
    import pandas as pd

AXIS, STARTS, HORIZON_S = "inertia", 100, 5.0
PLAIN, LINEARIZING = THREE[0], THREE[-1]

SLACK = 0.1
"""A tenth more time is no problem of its own."""


@claim(
    id="C30",
    section="2.4",
    equation="(2.15)",
    quote="""
        There are no problems with model accuracy because the matrices B and Bdot are all calculated within the
        regulator.
    """,
    correction="It loses no more starts than a law without a model, but takes longer.",
    written="2026-11-24 fb18d38",
    sentence="Feedback linearization has no problem of model accuracy.",
    question="Does an inertia that is not the model's harm it more than the law on R, which cancels nothing?",
    criterion=f"""
        B and Bdot are kinematics, which the regulator knows exactly; what it cannot know is whether the body turns as
        commanded. Axis {AXIS} of tasks/conditions: a body of 0.5 to 2 times the inertia of the model, {STARTS} starts
        all over SO(3), the same for both laws. It holds
        if, at every level, the share that feedback linearization does not settle is not above the rotation-matrix law's
        (95 % intervals do not part), and its median settling time in seconds is at most {SLACK:.0%} above that law's;
        with a correction if the first alone is so; otherwise it does not hold. Reported: how much an inertia slows
        either, over its own time without an error.
    """,
    open="""
        Which errors are meant is not said. With (2.2) an error of the manipulator's model reaches every regulator as
        one of the inertia; errors of measurement are in the chapters on noise.
    """,
    earlier=(
        Earlier(
            "2026-11-23 bc126c2",
            """
            Each law's median was taken over its own without an error: feedback linearization was slowed by more, and
            was still the faster law in seconds.
            """,
            Word.CORRECTED,
        ),
    ),
)
def c30(results):
    """Both laws on bodies heavier and lighter than the model."""
    gains = results.gains()
    plain, linearizing = (results.found_by(off_model, law, gains, results.seed) for law in (PLAIN, LINEARIZING))
    levels = sorted(set(plain["level"]) - {1.0})
    lost = [[share(~settled(one[one["level"] == level])) for one in (plain, linearizing)] for level in levels]
    times = [[_median(one, level) for one in (plain, linearizing)] for level in levels]
    own_times = [_median(one, 1.0) for one in (plain, linearizing)]
    keeps = all(own.low <= other.high for other, own in lost)
    word = word_of(keeps and all(own <= (1 + SLACK) * other for other, own in times), keeps)
    told = "; ".join(
        f"{level:g}: {own:.3f} s against {other:.3f} s, slowed by {own / own_times[1]:.2f} against "
        f"{other / own_times[0]:.2f}, {own_lost.k} against {other_lost.k} lost"
        for level, (other, own), (other_lost, own_lost) in zip(levels, times, lost, strict=True)
    )
    return word, evidence(
        f"""Median settling time with an inertia of so many times the model's, feedback linearization against the
        rotation matrix, of {STARTS} starts each: {told}. A linear system of twice the inertia is slowed by
        {closed_form.linear_settling(gains.kp / 2, gains.kv / 2) / closed_form.linear_settling(*gains):.2f}.""",
        len(plain) + len(linearizing),
        ("experiment",),
    )


def _median(rows: pd.DataFrame, level: float) -> float:
    return float(rows.loc[rows["level"] == level, "settling_time_s"].median())


@functools.cache
def off_model(law: str, gains: Gains, seed: int) -> pd.DataFrame:
    """Rows of robustness.parquet of a law along the axis."""
    from bench.experiments.experiment import Settings, Unit, rows_of

    unit = Unit("robustness", law, selector=AXIS, count=STARTS, total=STARTS, horizon_s=HORIZON_S)
    return rows_of(Settings(gains=gains, seed=seed), unit)
