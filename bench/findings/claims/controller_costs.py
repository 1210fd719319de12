"""C26: what whole controllers cost on either Jacobian (Murphy 1988, 3.2 and 4)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from bench.findings.claims import standing
from bench.findings.claims.adequacy import tallied
from bench.findings.claims.standing import ORDERED
from bench.findings.claims.tables import evidence, some
from bench.findings.claims.verdict import Earlier, Word, claim

if TYPE_CHECKING:
    import pandas as pd

LAW, COORDINATES = "feedback-linearized", "zyx-euler"

INVERSES = {6: "solve", 7: "pseudo-inverse"}
"""The inverse of the claims, by number of joints: what J^-1 means on six, and its least-squares heir on seven."""

BY_EULER, BY_COMMON, ON_MATRIX = (
    f"{LAW}/{COORDINATES}@analytic",
    f"{LAW}/{COORDINATES}@geometric",
    "rotation-matrix@geometric",
)
"""(3.7), (2.2) with (2.15), and (2.2) with the law on R; the inverse goes by the number of joints."""


def words(controller: str, joints: int) -> dict[str, str]:
    """The words of a controller's rows on so many joints."""
    law, _, by = controller.partition("@")
    regulator, _, representation = law.partition("/")
    return {"regulator": regulator, "representation": representation, "jacobian": by, "inverse": INVERSES[joints]}


def controller_costs(results, controller: str, joints: int) -> pd.DataFrame:
    """Its rows of costs.parquet, typical branch, a row a stage."""
    rows = results.table("costs", **words(controller, joints), branch="typical")
    return some(rows[rows["joints"] == joints], f"cost of {controller} on {joints} joints")


@claim(
    id="C26",
    section="4",
    equation="(3.7)",
    quote="""
        This Jacobian is commonly used in the literature without statement to the fact that it must exclude
        certain orientations and has a higher calculation cost.
    """,
    written="2026-11-24 fb18d38",
    sentence="The Euler Jacobian costs more operations to calculate.",
    question="What do the tallies of both say?",
    criterion=f"""
        costs.parquet, typical branch, on six joints with {INVERSES[6]} and on seven with {INVERSES[7]}: whole
        controllers, what MuJoCo computes for all of them left out. Pairs, the cheaper by the claim first: the same law
        both ways, {LAW}/{COORDINATES}@geometric, (2.2) with (2.15), and @analytic, (3.7); and
        rotation-matrix@geometric, (2.2), and the latter; with the goal's angles and without (the paper's accounting).
        It holds if the latter has no fewer flops, no fewer calls and more of one in every pair; otherwise it does not
        hold. Reported: the times of the compiled loops on each arm, where intervals part by more than
        {100 * standing.MEASURABLE:.0f} %, by which builds differ.
    """,
    earlier=(
        Earlier(
            "2026-11-21 f52a15d",
            """
            A median time that is not in order lowered 'holds', also where intervals overlap: 3583 ns against 3608 on
            one arm of four did.
            """,
            Word.CORRECTED,
        ),
        Earlier(
            "2026-11-23 953f62a",
            """
            Intervals alone parted times: (3.7) took 3.7 % less than (2.2) with (2.15) on one arm of four, in loops
            compiled apart, whose differences are the laws' to 3.6 %.
            """,
            Word.CORRECTED,
        ),
        Earlier(
            "2026-11-23 8772c3c",
            """
            Times counted where they differ by more than 4 %. That limit was set when the times were known, and with it
            the word changed: so the word is now of operations alone, and no time can change it.
            """,
            Word.HOLDS,
        ),
    ),
    open="""
        Higher than what is not said: than the common Jacobian with the
        same law is the narrow reading, than the cheapest controller without Euler angles the wide one; both are judged.
        What the literature states or leaves out is not judged here.
    """,
    readings=(
        "dearer than the same law on the common Jacobian",
        "dearer than the law on R on the common Jacobian",
    ),
)
def c26(results):
    """Pairs of controllers on six and seven joints."""
    timed, stands, listed = results.controller_timings(), [], []
    for joints, inverse in INVERSES.items():
        three = {f"{one}+{inverse}": controller_costs(results, one, joints) for one in (BY_COMMON, ON_MATRIX, BY_EULER)}
        alone, whole = ({name: tallied(own, goal) for name, own in three.items()} for goal in (False, True))
        times = standing.times_of(timed[timed["contender"].isin(list(three))])
        known = standing.Ledger(times, (alone, whole), math.nan, standing.MEASURABLE)
        *others, euler = three
        stands += [known.stand(one, euler) for one in others]
        told = (f"{', '.join(map(str, one.values()))}{goal}" for one, goal in ((alone, ""), (whole, ", goal and all")))
        listed.append(f"{joints} joints: {'; '.join(told)}; time {', '.join(known.over(euler, one) for one in others)}")
    word = Word.HOLDS if all(set(one.by_columns) == {ORDERED} for one in stands) else Word.FAILS
    return word, evidence(
        f"""Flops and calls a tick of (2.2) with (2.15), (2.2) with the law on R, and (3.7), and the time of (3.7) over
        each of the others': {"; ".join(listed)}. (3.7) is dearer in both columns in
        {sum(set(one.by_columns) == {ORDERED} for one in stands)} of {len(stands)} pairs; times part
        {sum(bool(one.by_time) for one in stands)} of them, {sum(one.by_time == ORDERED for one in stands)} in that
        order.""",
        3 * 2 * len(INVERSES) + len(timed),
        ("costs", "timings") if len(timed) else ("costs",),
    )
