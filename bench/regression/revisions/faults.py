"""The gate of faults: a user's laws as `bench judge` judges them, on both sides; a fault that base has not is one more.

Both sides are judged by this program's judge, so that a fault that appears is the law's and not the judge's.
"""

from collections.abc import Callable

from bench.contenders.described_law import described
from bench.errors import BadLaw
from bench.findings.judgement import Judgement
from bench.regression.revisions.checkouts import Checkout
from bench.regression.revisions.comparison import FAILED, FAULTS, IMPROVEMENT, PASSED, REGRESSION, Finding, Gate

Judge = Callable[..., list[Judgement]]


def compared(old: Checkout, new: Checkout, judge: Judge) -> tuple[Gate, list[Finding], tuple[Judgement, ...]]:
    """Faults of head's laws against those of base's, and the judgement of head's."""
    try:
        now = _judged(new, judge)
    except BadLaw as error:
        return Gate(FAULTS, FAILED, str(error)), [Finding(FAULTS, REGRESSION, "", "judged", "", "", str(error))], ()
    try:
        before = {one.name: one.faults for one in _judged(old, judge)}
    except BadLaw:
        before = {}
    found = [finding for one in now for finding in _findings(one, before.get(one.name, []))]
    kept = [fault for one in now for fault in one.faults if fault in before.get(one.name, [])]
    bad = sum(one.verdict == REGRESSION for one in found)
    says = f"{bad} new, {len(found) - bad} mended, {len(kept)} as in base{': ' if kept else ''}{', '.join(kept)}"
    return Gate(FAULTS, FAILED if bad else PASSED, says), found, tuple(now)


def _judged(side: Checkout, judge: Judge) -> list[Judgement]:
    return judge([described(law) for law in side.laws]) if side.laws else []


def _findings(one: Judgement, before: list[str]) -> list[Finding]:
    found = [
        Finding(FAULTS, REGRESSION, one.name, fault, "no", "yes", f"{one.name}: new fault: {fault}")
        for fault in one.faults
        if fault not in before
    ]
    return found + [
        Finding(FAULTS, IMPROVEMENT, one.name, fault, "yes", "no", f"{one.name}: no more: {fault}")
        for fault in before
        if fault not in one.faults
    ]
