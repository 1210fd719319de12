"""C26: what whole controllers cost on either Jacobian (Murphy 1988, 3.2 and 4)."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import numpy as np

from bench.findings.claims.adequacy import CALL_PRICE, tallied
from bench.findings.claims.costs import AGREES, MIXED, compared
from bench.findings.claims.tables import evidence, some
from bench.findings.claims.verdict import claim, word_of

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
    written="2026-11-21 f52a15d",
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
def c26(results):
    """Pairs of controllers on six and seven joints, in both accountings; then time."""
    pairs, listed = [], []
    for joints, with_goal in itertools.product(INVERSES, (False, True)):
        total = {
            one: tallied(controller_costs(results, one, joints), with_goal) for one in (BY_COMMON, ON_MATRIX, BY_EULER)
        }
        pairs += [compared(total[one], total[BY_EULER]) for one in (BY_COMMON, ON_MATRIX)]
        told = ", ".join(f"{flops} and {calls}" for flops, calls in total.values())
        listed.append(f"{joints} joints{', goal and all' if with_goal else ''}: {told}")
    said, is_dearer, timed = _timed(results)
    in_order = all(how == AGREES or (how == MIXED and price <= CALL_PRICE) for how, price in pairs)
    word = word_of(is_dearer and all(how == AGREES for how, _ in pairs), in_order)
    return word, evidence(
        f"""Flops and calls a tick of (2.2) with (2.15), (2.2) with the law on R, and (3.7): {"; ".join(listed)}. The
        last is dearer in both columns in {sum(how == AGREES for how, _ in pairs)} of {len(pairs)} pairs. {said}""",
        3 * len(listed) + timed,
        ("costs", "timings") if timed else ("costs",),
    )


def _timed(results) -> tuple[str, bool, int]:
    """What the timings say, whether none contradicts the order, and how many rows say it."""
    import pandas as pd

    frame = results.controller_timings()
    columns = []
    for controller in (BY_COMMON, ON_MATRIX, BY_EULER):
        own = frame[frame["contender"].isin([f"{controller}+{inverse}" for inverse in INVERSES.values()])]
        columns.append(own.groupby(["machine", "arm"], observed=True)["ns_per_tick"].median())
    table = pd.concat(columns, axis=1, keys=("common", "matrix", "euler")).dropna()
    if table.empty:
        return "No timings of all three to confirm it.", True, 0
    dearer = table["euler"] > np.maximum(table["common"], table["matrix"])
    medians = ", ".join(f"{1e-3 * table[name].median():.2f}" for name in table)
    said = f"Time a tick is in that order on {int(dearer.sum())} of {len(table)} arms and machines ({medians} µs)."
    return said, bool(dearer.all()), 3 * len(table)
