"""An advised law in words, for pages, cards and commands alike; `called` names a law as they do."""

import itertools
import math
from collections.abc import Callable, Sequence

from bench.findings.selection.needs import GENERAL, Decision, Measured
from tasks.situation import COORDINATES, Coordinate

NAMED = 3
"""Laws named where several tie; the others are counted."""

Called = Callable[[str], str]


def standing(one: Decision, called: Called) -> str:
    """Say that the advised law is alone on the Pareto front, or with which laws it ties."""
    if len(one.asked) == 1:
        return "No other published or adapted law of this run meets these conditions."
    if not one.tied:
        return (
            f"{len(one.asked)} published or adapted laws meet these conditions; it is at least as good as the others "
            "on every criterion and better on one."
        )
    return f"It ties with {together([called(law) for law in one.tied])} and is the simplest of these."


def together(words: Sequence[str], named: int = NAMED) -> str:
    """Join names as "a, b and c"; of many, the first so many and how many more."""
    more = len(words) - named
    if more > 1:
        return f"{', '.join(words[:named])} and {more} more"
    *first, last = words or ("",)
    return f"{', '.join(first)} and {last}" if first else last


def cost(found: Measured, law: str) -> str:
    """Flops and calls a tick, and of a law that was timed its share of a whole controller's tick."""
    flops, calls = found.tables.spent(law)
    share = found.number("tick", law)
    timed = "" if math.isnan(share) else f", {share:.1f} % of a whole controller's tick"
    return f"{flops} + {calls} operations{timed}" if calls else f"{flops} operations{timed}"


WORDS = {"effort": "effort", "peak": "peak command", "variation": "variation", "tick": "time a tick"}
TIMES = {"time": "99 %", "worst": "slowest start"}
"""Criteria, and in TIMES settling times, as a list of what a law is better or worse by has them."""


def compare(found: Measured, law: str, other: str) -> str:
    """Say by which criteria a law is better and worse than another in a run; by all others they tie."""
    both = [one for one in GENERAL if {law, other} <= set(found.values[one])]
    better, worse = (
        name_criteria([one for one in both if found.beats(one, *pair)]) for pair in ((law, other), (other, law))
    )
    return f"Beside {other} it is better by {better}, worse by {worse}."


def name_criteria(names: Sequence[str]) -> str:
    """List criteria, the settling times among them in brackets."""
    words = [word for name, word in WORDS.items() if name in names]
    times = [word for name, word in TIMES.items() if name in names]
    return ", ".join([*words, *([f"settling time ({', '.join(times)})"] if times else [])]) or "nothing"


def describe_bounds(bounds: dict[str, list[tuple[float, bool]]]) -> str:
    """Say where nothing beats a law, one number away from the nominal situation at a time (`regions.find_bounds`)."""
    parts, free = [], []
    for name, every in bounds.items():
        line = [one for one in every if name != "jump" or one[0]]  # 0 is no jump, and no end of a range
        runs = itertools.groupby(line, lambda one: one[1])
        spans = [[value for value, _ in some] for is_unbeaten, some in runs if is_unbeaten]
        if spans and len(spans[0]) == len(line):
            free.append(NAMES[name])
        elif spans:
            parts.append(f"{NAMES[name]} {together([_span(COORDINATES[name], span[0], span[-1]) for span in spans])}")
    if free:
        parts.append(f"every {together(free, len(free))} that was tried")
    return "; ".join(parts) or "nowhere"


NAMES = {
    "zeta": "damping ratio",
    "bound": "bound",
    "delay": "delay",
    "period": "period",
    "inertia": "inertia",
    "unevenness": "unevenness of the inertia",
    "spin": "spin",
    "jump": "time at which the goal jumps",
}
"""What the numbers of a situation are called in a sentence."""


def _span(one: Coordinate, low: float, high: float) -> str:
    """Return a range of a number; up to or from one value where the other end is the extreme one that was tried."""
    low_text, high_text = (one.text.format(value) for value in (low, high))
    if low == high:
        return low_text
    if low == min(one.levels):
        return f"up to {high_text}"
    return f"from {low_text}" if high == max(one.levels) else f"{low_text} to {high_text}"
