"""An advised law in words, for pages, cards and commands alike; `called` names a law as they do."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from bench.findings.perturbed import studied
from bench.findings.selection.criteria import BOUND, BY_NAME, Criterion
from bench.findings.selection.measured import Measured
from bench.findings.selection.needs import NEARLY, SURE, TRIED, Decision, best_by, has_all

NAMED = 3
"""Laws named where several tie; the others are counted."""

Called = Callable[[str], str]


def standing(one: Decision, called: Called) -> str:
    """Say that the advised law is alone on the Pareto front, or with which laws it ties."""
    if len(one.asked) == 1:
        return "No other published law of this run meets these conditions."
    if not one.tied:
        return (
            f"{len(one.asked)} published laws meet these conditions; it is at least as good as the others on every "
            "criterion and better on one."
        )
    return f"It ties with {together([called(law) for law in one.tied])} and is the simplest of these."


def together(words: Sequence[str]) -> str:
    """Join names as "a, b and c"; of many, the first NAMED and how many more."""
    more = len(words) - NAMED
    if more > 1:
        return f"{', '.join(words[:NAMED])} and {more} more"
    *first, last = words or ("",)
    return f"{', '.join(first)} and {last}" if first else last


def leaders(found: Measured, criterion: str, called: Called) -> str:
    """Return what is best by a criterion, of all laws and of those that settle from every start: one law, or a tie."""
    every = best_by(found, criterion, found.laws)
    sure = best_by(found, criterion, [law for law in found.laws if has_all(found, law, SURE)])
    if not sure or set(every) <= set(sure):
        return _tie(every, called)
    return f"{_tie(every, called)}; among laws that settle from every start: {_tie(sure, called)}"


def faster_under_a_bound(found: Measured, usual: str, called: Called = str) -> str:
    """Say which law that fails at some directed start is the fastest under a bound, if it is faster than the usual."""
    rows = studied()
    at = rows[(rows["axis"].astype(str) == "saturation") & (rows["level"] == BOUND)].set_index("contender")
    laws = [law for law in found.laws if has_all(found, law, (TRIED, NEARLY)) and found.number("lost", law)]
    times = at["median_s"].reindex([usual, *laws]).dropna()
    if usual not in times or times.idxmin() == usual:
        return ""
    law = times.idxmin()
    own, other = times[law], times[usual]
    return (
        f"Under a command bounded by {BOUND:g} rad/s² {called(law)} settles {100 * (1 - own / other):.0f} % sooner in "
        f"the median ({own:.3f} s against {other:.3f} s, {at['starts'][law]} starts), but gets stuck at 180° rotations."
    )


def _tie(laws: Sequence[str], called: Called) -> str:
    named = together([called(law) for law in laws]) or "none"
    return f"{named} (a tie)" if len(laws) > 1 else named


def cost(found: Measured, law: str) -> str:
    """Flops and calls a tick, and of a law that was timed its share of a whole controller's tick."""
    flops, calls = found.tables.spent(law)
    share = found.number("tick", law)
    timed = "" if math.isnan(share) else f", {share:.1f} % of a whole controller's tick"
    return f"{flops} + {calls} operations{timed}" if calls else f"{flops} operations{timed}"


def number(criterion: Criterion | str, value: float) -> str:
    """Return a number with its unit, as its criterion writes it."""
    one = BY_NAME[criterion] if isinstance(criterion, str) else criterion
    if math.isnan(value):
        return "not measured"
    if math.isinf(value):
        return "none" if one.sense < 0 else "never"
    return f"{one.form.format(value)} {one.unit}".strip()
