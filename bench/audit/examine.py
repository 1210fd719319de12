"""Ask a function, find its convention, and let every fault look at the answers."""

import functools
import warnings
from collections.abc import Callable

import numpy as np

from bench.audit import convention, pairs
from bench.audit.calls import Call, ways_to_call
from bench.audit.convention import TAKES, Convention, Stated
from bench.audit.examined import (
    NO_THREE_NUMBERS,
    Examined,
    Fresh,
    Lost,
    PairEvidence,
    Symptom,
    evaluate,
    inputs,
)
from bench.audit.faults import FoundFault, every_fault
from bench.audit.report import Report
from bench.base.errors import BadFunction


def examine(
    function: Callable, stated: Stated, name: str, fresh: Fresh | None = None, watch: Callable = lambda call: call
) -> Report:
    """Report on a function; without a convention, on the input for which the mistake is known.

    `fresh` loads it once more, with none of what it has kept; `watch` takes and returns a function of two arrays.
    """
    stated.check([one.name for one in every_fault()])
    reports = []
    with warnings.catch_warnings(), np.errstate(all="ignore"):  # answers may be infinite, or no numbers
        warnings.simplefilter("ignore", RuntimeWarning)
        try:
            for call, found in understood(function, stated, name, watch):
                again = None if fresh is None else functools.partial(call_again, call, fresh, watch)
                examined = Examined(watch(call.wrap(function)), stated, call.takes, found, again)
                reports.append(Report(name, len(examined.e), call, found, findings(examined)))
        except Lost as lost:
            return report_lost(name, lost)
    return min(reports, key=lambda one: UNKNOWN in one.faults)


def call_again(call: Call, fresh: Fresh, watch: Callable) -> Callable:
    """Return a function that was loaded once more, called as before."""
    return watch(call.wrap(fresh()))


def report_lost(name: str, lost: Lost) -> Report:
    """Return the report on a function that did not come back from a call: that fault alone."""
    (fault,) = (one for one in every_fault() if one.name == lost.fault)
    evidence = PairEvidence(lost.now, lost.goal, lost.how)
    call = Call("matrix" if lost.now.shape == (3, 3) else "wxyz")
    return Report(
        name,
        0,
        call,
        None,
        (FoundFault(fault, Symptom(f"{lost.how}; nothing more was tried", evidence)),),
    )


UNKNOWN, VOID = "misaligned", "memory"


def findings(examined: Examined) -> tuple[FoundFault, ...]:
    """Return what is wrong with it, faults first, without what others explain."""
    found = [(one, one.find(examined)) for one in every_fault()]
    names = {one.name for one, what in found if what}
    if VOID in names - set(examined.stated.allow):  # every other answer is in doubt
        found = [(one, what) for one, what in found if one.name == VOID]
    kept = [
        FoundFault(one, what, one.name in examined.stated.allow)
        for one, what in found
        if what and not names & set(one.unless)
    ]
    return tuple(sorted(kept, key=lambda one: not one.is_fault))


def understood(function: Callable, stated: Stated, name: str, watch: Callable) -> list[tuple[Call, Convention | None]]:
    """Find how it is called and its convention; if nothing explains its answers, all that it may take."""
    every = pairs.every_pair()
    some = every.chosen(every.at("wide", "close", "fine", "near-identity"))
    few = some.chosen(slice(0, None, 90))
    ways = [ways_to_call(function, takes) for takes in possible(stated)]
    reasons: dict[str, list[str]] = {}
    for calls in ([plain for plain, *_ in ways], [call for _, *others in ways for call in others]):
        answered: list[tuple[float, Call, Convention | None]] = []
        for call in calls:
            watched = watch(call.wrap(function))
            first = evaluate(watched, *inputs(call.takes, few))
            if sum(map(bool, first.raised)) <= len(first.raised) / 2:
                share, found = convention.find(call.takes, some, evaluate(watched, *inputs(call.takes, some)).e)
                answered.append((share if found else 0.0, call, found))
            elif call in (plain for plain, *_ in ways):
                reasons.setdefault(next(filter(None, first.raised)), []).append(call.takes)
        if best := max(answered, key=lambda one: one[0], default=None):
            return [best[1:]] if best[2] else [one[1:] for one in answered]
    said = (f"given {' or '.join(takes)}: {one.removeprefix(NO_THREE_NUMBERS)}" for one, takes in reasons.items())
    cure = next(
        cure
        for shape, cure in CURES.items()
        if any(f"{NO_THREE_NUMBERS}{shape}" in one for one in (*reasons, NO_THREE_NUMBERS))
    )
    raise BadFunction(
        f"{name} returns three numbers neither of two 3 x 3 matrices nor of two quaternions, nor of batches of one, 9 "
        f"numbers, SciPy's rotations or poses ({'; '.join(said)}); {cure}"
    )


CURES = {
    "an array of shape (4,)": "of an error quaternion return the vector part, times the sign of the scalar part",
    "an array of shape (3, 3)": "of an error matrix return the axis, as scipy's Rotation.from_matrix(X).as_rotvec()",
    "an array of shape (6,)": "of six numbers return the three of the orientation, as: mine(R, R_d)[3:]",
    "an array of shape ()": "an angle has no axis: return angle times axis",
    "tuple": "of an axis and an angle return the product",
    "": "write a function of two matrices that calls it, as: def f(R, R_d): return mine(p, R, p, R_d), or mine("
    "torch.tensor(R), torch.tensor(R_d))",
}
"""What is returned in the place of three numbers -> the cure."""


def possible(stated: Stated) -> tuple[str, ...]:
    """Return what may be tried: of quaternions both orders, for the wrong one is a fault that is looked for."""
    others = TAKES if stated.takes is None else () if stated.takes == "matrix" else TAKES[1:]
    return tuple(dict.fromkeys((stated.takes or TAKES[0], *others)))
