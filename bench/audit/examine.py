"""Ask a function, find its convention, and let every fault look at the answers."""

import warnings
from collections.abc import Callable

import numpy as np

from bench.audit import convention, pairs
from bench.audit.convention import TAKES, Convention, Stated
from bench.audit.examined import NO_THREE_NUMBERS, Evidence, Examined, Found, Fresh, Lost, evaluate, inputs
from bench.audit.faults import Finding, every_fault
from bench.audit.report import Report
from bench.base.errors import BadFunction


def examine(function: Callable, stated: Stated, name: str, fresh: Fresh | None = None) -> Report:
    """Report on a function; without a convention, on the input for which the mistake is known.

    Args:
        fresh: loads the function once more, with none of what it has kept.
    """
    stated.check([one.name for one in every_fault()])
    reports = []
    with warnings.catch_warnings(), np.errstate(all="ignore"):  # answers may be infinite, or no numbers
        warnings.simplefilter("ignore", RuntimeWarning)
        try:
            for takes, found in understood(function, stated, name):
                examined = Examined(function, stated, takes, found, fresh)
                reports.append(Report(name, len(examined.e), takes, found, findings(examined)))
        except Lost as lost:
            return report_lost(name, lost)
    return min(reports, key=lambda one: UNKNOWN in one.faults)


def report_lost(name: str, lost: Lost) -> Report:
    """Return the report on a function that did not come back from a call: that fault alone."""
    (fault,) = (one for one in every_fault() if one.name == lost.fault)
    evidence = Evidence(lost.now, lost.goal, lost.how)
    takes = "matrix" if lost.now.shape == (3, 3) else "quaternion"
    return Report(name, 0, takes, None, (Finding(fault, Found(f"{lost.how}; nothing more was tried", evidence)),))


UNKNOWN, VOID = "misaligned", "memory"


def findings(examined: Examined) -> tuple[Finding, ...]:
    """Return what is wrong with it, faults first, without what others explain."""
    found = [(one, one.find(examined)) for one in every_fault()]
    names = {one.name for one, what in found if what}
    if VOID in names - set(examined.stated.accept):  # every other answer is in doubt
        found = [(one, what) for one, what in found if one.name == VOID]
    kept = [
        Finding(one, what, one.name in examined.stated.accept)
        for one, what in found
        if what and not names & set(one.unless)
    ]
    return tuple(sorted(kept, key=lambda one: not one.is_fault))


def understood(function: Callable, stated: Stated, name: str) -> list[tuple[str, Convention | None]]:
    """Find what it takes and its convention; if nothing explains its answers, all that it may take.

    Errors:
        BadFunction: of nothing that it may take does it return three numbers.
    """
    every = pairs.every_pair()
    some = every.chosen(every.at("wide", "close", "fine", "near-identity"))
    known: list[tuple[float, str, Convention]] = []
    answered: list[tuple[str, Convention | None]] = []
    reasons = {}
    for takes in possible(stated):
        first = evaluate(function, *inputs(takes, some.chosen(slice(0, None, 90))))
        if sum(map(bool, first.raised)) > len(first.raised) / 2:
            reasons[takes] = next(filter(None, first.raised))
            continue
        answered.append((takes, None))
        share, found = convention.find(takes, some, evaluate(function, *inputs(takes, some)).e)
        if found:
            known.append((share, takes, found))
    if not answered:
        said = "; ".join(f"given {one}: {reason.removeprefix(NO_THREE_NUMBERS)}" for one, reason in reasons.items())
        raise BadFunction(
            f"{name} returns three numbers neither of two 3 x 3 matrices nor of two quaternions ({said}); wrap it in "
            f"a function of these that returns three, as: def f(R, R_d): return mine(R[None], R_d[None])[0]"
        )
    return [max(known, key=lambda one: one[0])[1:]] if known else answered


def possible(stated: Stated) -> tuple[str, ...]:
    """Return what may be tried: of quaternions both orders, for the wrong one is a fault that is looked for."""
    if stated.takes is None:
        return TAKES
    others = () if stated.takes == "matrix" else TAKES[1:]
    return tuple(dict.fromkeys((stated.takes, *others)))
