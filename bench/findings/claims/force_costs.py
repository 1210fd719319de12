"""C33: what force control costs on either Jacobian (Murphy 1988, 3.9-3.12 and 3.3)."""

from __future__ import annotations

import functools
import math

from bench.control.contact_controller import PAPERS_FORM
from bench.findings.claims import adequacy
from bench.findings.claims.adequacy import CALLS
from bench.findings.claims.euler_jacobian import COORDINATES
from bench.findings.claims.side_by_side import BASE
from bench.findings.claims.standing import ORDERED, Operations, by_columns
from bench.findings.claims.tables import evidence
from bench.findings.claims.verdict import claim, word_of

FEW = 0.1
"""Of the flops of the whole tick: up to a tenth more is a few."""

EULER = f"hybrid/{COORDINATES}"


@claim(
    id="C33",
    section="3.3",
    equation="(3.12)",
    quote="""
        A position/force controller for the Cartesian model from Section 3.2 requires a few more calculations due to the
        Euler Jacobian.
    """,
    value="a few more",
    correction="It requires more, and not a few.",
    written="2026-11-23 bc126c2",
    sentence="Force control on the Euler Jacobian needs a few more calculations.",
    question="What do both controllers in contact take a tick, and is the difference a few?",
    criterion=f"""
        Counted from the code that runs, arm of six joints, two compliant turns, typical branch: {EULER} and {BASE}, the
        same law but for the Jacobian, form '{PAPERS_FORM}', the paper's. More: no fewer flops and calls, and more of
        one. A few: at most {FEW:.0%} more flops. It holds if both are so; with a correction if only the first is;
        otherwise it does not hold.
    """,
    open="The paper counts nothing. What MuJoCo computes for both is left out.",
)
def c33(results):
    """Flops and calls of both in contact."""
    base, euler = (results.found_by(in_contact, f"{one}+{PAPERS_FORM}") for one in (BASE, EULER))
    price = adequacy.ledger(results).price
    weighed = f", {euler.weighed(price) / base.weighed(price) - 1:.0%} more with a call at its price in C12's times"
    is_more, more = by_columns(base, euler) == ORDERED, euler.flops / base.flops - 1
    return word_of(is_more and more <= FEW, is_more), evidence(
        f"""Flops and calls a tick: {base} on the common Jacobian, {euler} on Euler's: {more:.1%} more flops and
        {euler.calls - base.calls} calls{weighed if math.isfinite(price) else ""}.""",
        2,
        ("experiment",),
    )


@functools.cache
def in_contact(controller: str) -> Operations:
    """Of a controller's typical tick."""
    from bench.control.registry import find_controller
    from bench.counting import TOTAL, flops
    from bench.counting.in_contact import cost_in_contact

    numbers = cost_in_contact(find_controller(controller)).typical.of(TOTAL)
    return Operations(flops(numbers), sum(numbers[name] for name in CALLS))
