"""An advised law in words, for pages, cards and commands alike; `called` names a law as they do."""

import itertools
import math
from collections.abc import Callable, Sequence
from pathlib import Path

from bench.findings.amounts import count, join_words
from bench.findings.selection.pairs import find_slower
from bench.findings.selection.regions import (
    RULE,
    STUDY,
    Rule,
    RuleVerdict,
    find_overshooting,
    list_ours,
    meets,
)
from bench.findings.selection.run_rows import Compared
from bench.findings.selection.tables import ComparedRows
from bench.findings.selection.unbeaten import (
    SPOKEN,
    Rival,
    ValueOnLine,
    compare_with_advised,
    find_population,
    find_price,
    find_runner_up,
    follow_lines,
    measure_shares,
)
from tasks.situation import COORDINATES, Coordinate

NAMED = 3
"""Laws named where several tie; the others are counted."""

Called = Callable[[str], str]


def standing(verdict: RuleVerdict, called: Called) -> str:
    """Say that the advised law alone is unbeaten, or with which laws it ties."""
    if verdict.eligible == 1:
        return "No other law of this run meets the requirements."
    if not verdict.tied:
        return (
            f"{verdict.eligible} laws meet the requirements. Each of the other published and adapted laws is more than "
            f"{percent(RULE.tie)} slower than one of these laws; the advised law is not."
        )
    return f"The law ties with {together([called(law) for law in verdict.tied])} and is the simplest of these laws."


def together(words: Sequence[str], named: int = NAMED) -> str:
    """Join names as "a, b and c"; of many, the first so many and how many more."""
    more = len(words) - named
    if more > 1:
        return f"{', '.join(words[:named])} and {more} more"
    *first, last = words or ("",)
    return f"{', '.join(first)} and {last}" if first else last


def cost(tables: ComparedRows, law: str) -> str:
    """Flops and calls a tick, and of a law that was timed its share of a whole controller's tick."""
    flops, calls = tables.spent(law)
    share = tables.ticks.get(law)
    timed = "" if share is None else f", {share:.1f} % of the time of a whole controller's step"
    operations = f"{flops} operations and {calls} calls" if calls else f"{flops} operations"
    return f"{operations}{timed}"


LACKS = {
    "lost": ("uniform start", "does not settle from {}"),
    "stuck": ("exact 180° rotation", "does not settle from {}"),
    "unwound": ("uniform start", "turns the long way from {}"),
    "trapped": ("episode", "is trapped at 180° by a sensor error in {}"),
}
"""Counts of a run that the requirements forbid: what is counted, and what a law does."""


def compare(compared: Compared, law: str, other: str, rule: Rule = RULE) -> str:
    """Say which of two laws of a run is faster by the rule, and what the first one lacks of the requirements."""
    laws = [law, other]
    times = [compared.row(name)["time"] for name in laws]
    [[_, is_slower], [is_faster, _]] = find_slower(compared.pairs, laws, rule.tie)
    if is_slower or is_faster:
        verdict = f"by our rule, {law} is {'slower' if is_slower else 'faster'}"
    else:
        verdict = "by our rule, the two laws tie"
    return (
        f"99 % of the uniform starts settle within {_seconds(times[0])} with {law} and within {_seconds(times[1])} "
        f"with {other}; {verdict}. {describe_lacks(compared, law, rule)}"
    )


def _seconds(time: float) -> str:
    return f"{time:.3f} s" if math.isfinite(time) else "no time that was simulated"


def describe_lacks(compared: Compared, law: str, rule: Rule = RULE) -> str:
    """Say what a law of a run lacks of the requirements of a rule, by what was tried there."""
    row = compared.row(law)
    parts = []
    for column, (noun, words) in LACKS.items():
        number = row.get(column, math.nan)
        if number > 0:
            parts.append(words.format(count(int(number), noun)))
    has = meets(compared.rows, rule._replace(overshoot=math.inf))
    overshoots = find_overshooting(compared.rows, has, rule.overshoot)
    if overshoots[compared.laws.index(law)]:
        parts.append(f"overshoots by {row['overshoot']:.0f}°, over {rule.overshoot:g}° more than the least")
    if not row["trapped"] >= 0:
        parts.append("was not tried with noise at 180°")
    if parts:
        return f"{law} lacks what we require: it {join_words(parts)}."
    return f"{law} meets our requirements here."


def describe_bounds(bounds: dict[str, list[tuple[float, bool]]]) -> str:
    """Say where no law of a set is faster, one number away from the nominal situation at a time.

    bounds: of `unbeaten.find_bounds`. The sentence around this names the set.
    """
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
        parts.append(f"every value that we tried for {together(free, len(free))}")
    return "; ".join(parts) or "nowhere"


def describe_rivals(
    lines: dict[str, list[ValueOnLine]], among_all: bool, called: Called = str
) -> str:
    """Say where laws of a set are faster, in brackets which one by the most, and by how much of the time.

    lines: of `unbeaten.follow_lines`. among_all: of all published and adapted laws, else of those that meet the
    requirements there.
    """
    parts = []
    for name, places in lines.items():
        fastest = []
        for place in places:
            rivals = [rival for rival in place.standing.rivals if among_all or rival.qualified]
            if name != "jump" or place.value:  # 0 is no jump
                fastest.append((place.value, rivals[0] if rivals else None))
        spans = []
        for has_rival, run in itertools.groupby(fastest, lambda pair: pair[1] is not None):
            span = list(run)
            if has_rival:
                values = _span(COORDINATES[name], span[0][0], span[-1][0])
                spans.append(f"{values} ({describe_fastest([rival for _, rival in span if rival], called)})")
        if spans:
            parts.append(f"{NAMES[name]} {together(spans, len(spans))}")
    return "; ".join(parts) or "none"


def describe_fastest(rivals: list[Rival], called: Called = str) -> str:
    """Name the rival that is faster by the most, and say by how much.

    The other law does not settle in time where a rival is faster by the whole of its time.
    """
    timed = [rival for rival in rivals if rival.faster < 1.0]
    if not timed:
        return f"{called(rivals[0].law)}, and the other law does not settle in time"
    most = max(timed, key=lambda rival: rival.faster)
    more = " or more" if len(timed) < len(rivals) else ""
    return f"{called(most.law)}, {percent(most.faster)}{more}"


def percent(share: float) -> str:
    """Write a share in whole per cent."""
    return f"{100 * share:.0f} %"


def describe_shares(law: str, folder: Path = STUDY) -> str:
    """Say in how many drawn situations no law of either set is faster than a law, and in how many it fails itself."""
    population = find_population(folder)
    shares = measure_shares(law, folder, tie=SPOKEN)
    close = measure_shares(law, folder)
    laws = len(population.qualified) + len(population.excluded)
    return (
        f"In {percent(shares.qualified.value)} of {shares.qualified.of} random situations, no "
        f"other law that meets the requirements is more than {percent(SPOKEN)} faster. If the law "
        f"is compared with all {laws} published and adapted laws of the map, the share is "
        f"{percent(shares.all.value)}; {len(population.excluded)} of these laws fail a "
        f"requirement in every situation. If a law that is {percent(RULE.tie)} faster counts as "
        f"faster, the two shares are {percent(close.qualified.value)} and "
        f"{percent(close.all.value)}. In {percent(shares.losing.value)} of the situations, the "
        "law itself never settles from some starts."
    )


def describe_lines(law: str, called: Called = str, folder: Path = STUDY) -> str:
    """Say where, one number at a time, a law of either set is faster than a law, which one, and by how much."""
    lines = follow_lines(law, folder, tie=SPOKEN)
    qualified, everything = (describe_rivals(lines, among_all, called) for among_all in (False, True))
    first = (
        "If one number of the nominal situation changes at a time, no published or adapted law is "
        f"more than {percent(SPOKEN)} faster than {called(law)}"
    )
    if everything == "none":
        return f"{first}."
    if qualified == "none":
        return f"{first} and meets the requirements. Laws that fail a requirement are faster at: {everything}."
    return (
        f"{first}, except at: {everything}. The brackets name the fastest law, and say how much "
        f"faster this law is. Laws that meet the requirements are more than {percent(SPOKEN)} faster "
        f"at: {qualified}."
    )


def list_faster_ours(folder: Path = STUDY) -> list[str]:
    """Return our own laws that are more than SPOKEN faster than the advised law in some drawn situation."""
    return [law for law in list_ours(folder) if compare_with_advised(law, folder).number]


def describe_ours(called: Called = str, folder: Path = STUDY) -> str:
    """Say how those of our own laws compare that are faster than the advised law in some drawn situation."""
    return " ".join(describe_law_of_ours(law, called, folder) for law in list_faster_ours(folder))


def describe_law_of_ours(law: str, called: Called = str, folder: Path = STUDY) -> str:
    """Say in how many drawn situations a law of ours is faster than the advised one, and beaten by no law of a set."""
    shares = measure_shares(law, folder, tie=SPOKEN)
    return (
        f"We do not advise our own law, {called(law)} (2026, simulation only, not reviewed). Our "
        f"law is more than {percent(SPOKEN)} faster than the advised law in "
        f"{percent(compare_with_advised(law, folder).value)} of the random situations. In "
        f"{percent(shares.qualified.value)} of the random situations our law meets the "
        "requirements, and no published or adapted law that meets them is more than "
        f"{percent(SPOKEN)} faster. If our law is compared with all published and adapted laws, "
        f"the share is {percent(shares.all.value)}."
    )


def describe_price(law: str, folder: Path = STUDY, called: Called = str) -> str:
    """Say what a law costs beside the law of the second widest region: command, overshoot, time at equal peak."""
    price = find_price(law, folder)
    other = find_runner_up(folder)
    if other is None:
        return f"The law commands up to {price.peak:.1f} kp."
    beside = find_price(other, folder)
    return (
        f"The price: the law commands up to {price.peak:.1f} kp ({called(other)}: "
        f"{beside.peak:.1f} kp). With gains that give both laws the same peak command (peak, in rad/s²), "
        f"99 % of the starts settle in {price.at_equal_peak:.1f}/√peak seconds ({called(other)}: "
        f"{beside.at_equal_peak:.1f}/√peak seconds). The median overshoot in the random "
        f"situations is {price.typical_overshoot:.1f}° ({called(other)}: "
        f"{beside.typical_overshoot:.1f}°)."
    )


NAMES = {
    "zeta": "damping ratio",
    "bound": "command limit",
    "delay": "delay",
    "period": "control period",
    "inertia": "inertia ratio",
    "unevenness": "spread of the principal inertias",
    "spin": "initial spin",
    "jump": "time of the goal jump",
}
"""What the numbers of a situation are called in a sentence."""


def _span(one: Coordinate, low: float, high: float) -> str:
    """Return a range of a number; up to or from one value where the other end is the extreme one that was tried."""
    low_text, high_text = (one.text.format(value) for value in (low, high))
    if low == high:
        return low_text
    if low == min(one.levels):
        return f"up to {high_text}"
    return f"{low_text} or more" if high == max(one.levels) else f"{low_text} to {high_text}"
