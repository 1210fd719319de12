"""C33: what force control costs on either Jacobian (Murphy 1988, 3.9-3.12 and 3.3)."""

from __future__ import annotations

import functools

from bench.control.contact_controller import PAPERS_FORM
from bench.findings.claims.adequacy import CALLS
from bench.findings.claims.euler_jacobian import COORDINATES
from bench.findings.claims.side_by_side import BASE
from bench.findings.claims.standing import ORDERED, Operations, by_columns
from bench.findings.claims.tables import evidence
from bench.findings.claims.verdict import Earlier, Word, claim, word_of

JOINTS = (6, 7)

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
    correction="On an arm of seven joints they are a few; on six they are more.",
    written="2026-11-24 b7bade9",
    earlier=(Earlier("2026-11-23 bc126c2", "Counted on an arm of six joints alone.", Word.CORRECTED),),
    sentence="Force control on the Euler Jacobian needs a few more calculations.",
    question="What do both controllers in contact take a tick, and is the difference a few?",
    criterion=f"""
        Counted from the code that runs, arms of six and of seven joints, two compliant turns, typical branch: {EULER}
        and {BASE}, the same law but for the Jacobian, form '{PAPERS_FORM}', the paper's. More: no fewer flops and
        calls, and more of one. A few: at most {FEW:.0%} more flops. It holds if both are so on both arms; with a
        correction if it is more on both and a few on one; otherwise it does not hold.
    """,
    open="The paper counts nothing. What MuJoCo computes for both is left out.",
)
def c33(results):
    """Flops and calls of both in contact, on arms of six and of seven joints."""
    said, is_more, is_few = [], [], []
    for joints in JOINTS:
        base, euler = (results.found_by(in_contact, f"{one}+{PAPERS_FORM}", joints) for one in (BASE, EULER))
        more = euler.flops / base.flops - 1
        is_more.append(by_columns(base, euler) == ORDERED)
        is_few.append(more <= FEW)
        said.append(f"{joints} joints: {base} and {euler}, {more:.1%} more flops and {euler.calls - base.calls} calls")
    return word_of(all(is_more) and all(is_few), all(is_more) and any(is_few)), evidence(
        f"""Flops and calls a tick on the common Jacobian and on Euler's: {"; ".join(said)}.""",
        2 * len(JOINTS),
        ("experiment",),
    )


@functools.cache
def in_contact(controller: str, joints: int) -> Operations:
    """Count a controller's typical tick on an arm of so many joints."""
    from bench.control.registry import find_controller
    from bench.counting import TOTAL, flops
    from bench.counting.in_contact import cost_in_contact

    numbers = cost_in_contact(find_controller(controller), joints=joints).typical.of(TOTAL)
    return Operations(flops(numbers), sum(numbers[name] for name in CALLS))
