"""C33: what force control costs on either Jacobian (Murphy 1988, 3.9-3.12 and 3.3)."""

from __future__ import annotations

import functools
import math

from bench.control.contact_controller import PAPERS_FORM
from bench.findings.claims import adequacy
from bench.findings.claims.adequacy import CALLS
from bench.findings.claims.controller_costs import INVERSES
from bench.findings.claims.euler_jacobian import COORDINATES
from bench.findings.claims.side_by_side import BASE
from bench.findings.claims.standing import ORDERED, Operations, by_columns
from bench.findings.claims.tables import evidence
from bench.findings.claims.verdict import Earlier, Word, claim, word_of

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
    correction="A few more on an arm of seven joints; on one of six joints more than a tenth.",
    written="2026-11-24 fb18d38",
    sentence="Force control on the Euler Jacobian needs a few more calculations.",
    question="What do both controllers in contact take a tick, and is the difference a few?",
    criterion=f"""
        Counted from the code that runs, arms of six and of seven joints, two compliant turns, typical branch: {EULER}
        and {BASE}, the same law but for the Jacobian, form '{PAPERS_FORM}', the paper's. More: no fewer flops and
        calls, and more of one. A few: at most {FEW:.0%} more flops. It holds if both are so on both arms; with a
        correction if the first is so on both, and the second not on both; otherwise it does not hold.
    """,
    open="The paper counts nothing. What MuJoCo computes for both is left out. The limit of a tenth is ours.",
    earlier=(Earlier("2026-11-23 bc126c2", "Counted on six joints alone.", Word.CORRECTED),),
)
def c33(results):
    """Flops and calls of both in contact."""
    price, told, is_more, is_few = adequacy.ledger(results).price, [], [], []
    for joints in INVERSES:
        base, euler = (results.found_by(in_contact, f"{one}+{PAPERS_FORM}", joints) for one in (BASE, EULER))
        weighed = f", {euler.weighed(price) / base.weighed(price) - 1:.0%} more with a call at its price in C12's times"
        more = euler.flops / base.flops - 1
        is_more.append(by_columns(base, euler) == ORDERED)
        is_few.append(more <= FEW)
        told.append(
            f"on {joints} joints {base} on the common Jacobian, {euler} on Euler's: {more:.1%} more flops and "
            f"{euler.calls - base.calls} calls{weighed if math.isfinite(price) else ''}"
        )
    return word_of(all(is_more) and all(is_few), all(is_more)), evidence(
        f"Flops and calls a tick: {'; '.join(told)}.", 2 * len(told), ("experiment",)
    )


@functools.cache
def in_contact(controller: str, joints: int) -> Operations:
    """Of a controller's typical tick on an arm of so many joints."""
    from bench.control.registry import find_controller
    from bench.counting import TOTAL, flops
    from bench.counting.in_contact import cost_in_contact

    numbers = cost_in_contact(find_controller(controller), joints=joints).typical.of(TOTAL)
    return Operations(flops(numbers), sum(numbers[name] for name in CALLS))
