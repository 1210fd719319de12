"""The page that says which law to use: the map of situations, its regions, and what changes the advice."""

from collections.abc import Iterator
from typing import Any

from bench.experiments.situations import FIRST, MOST, NOISE_RAD
from bench.experiments.tables.run import Run
from bench.findings.amounts import count_of
from bench.findings.answer import NOT_TESTED, Answer, find_answer
from bench.findings.proofs.certificate import read_certificates
from bench.findings.selection import regions, sensitivity, words
from bench.findings.selection.checked import (
    LITTLE_DEG,
    NEAR_LEAST,
    count_weak_motors,
    read_weak_motors,
)
from bench.findings.selection.regions import decide_all, facts_of, find_regions, is_drawn, read_map
from bench.findings.selection.robots import ROBOTS, list_elsewhere
from bench.findings.selection.sensitivity import Rated
from bench.findings.selection.unbeaten import (
    SPOKEN,
    find_bounds,
    find_population,
    measure_shares,
)
from bench.findings.selection.words import describe_bounds, together
from bench.law.attribution import IN_WORDS
from bench.law.contenders.registry import find_contender
from report.figures.kit import families, html
from report.figures.kit.page import in_run
from report.figures.kit.spelling import prose
from report.figures.replication.conclusions import call_laws
from report.subjects import find_page
from tasks.situation import KP, NOMINAL

REGIONS = html.PageTable(
    "Law | Situations where this law is advised [%]:.0f | "
    "Situations where this law is unbeaten among the qualified laws [%]:.0f | "
    "Situations where this law is unbeaten among all laws [%]:.0f | "
    "Situations where this law does not settle from every start [%]:.0f | "
    "Values of one changed number at which no qualified law is faster than this law"
)
RULES = html.PageTable(
    "Rule | Law advised most often | Situations where this law is advised [%]:.0f | "
    "Situations where this law is unbeaten [%]:.0f | "
    "Situations where this rule and our rule advise different laws [%]:.0f"
)
RELIABLE = html.PageTable(
    "Advice in new situations | Situations where the advised law is unbeaten among the qualified "
    "laws | Situations where the advised law is unbeaten among all laws | Situations where a "
    f"qualified law is more than {100 * SPOKEN:.0f} % faster than the advised law | Median extra "
    "time [%] | Extra time that is not exceeded in 95 % of the situations [%]",
)
RULE_WORDS = {
    "the rule": "our rule",
    "noise is left out": "the noise test is left out",
    "overshoot is left out": "the overshoot is left out",
    "an overshoot of 2° more is too much": "a law may overshoot by 2°, in place of 5°, more than the law that "
    "overshoots least",
    "no memory": "laws with memory are left out",
    "a continuous command": "laws whose command is not continuous are left out",
    "the median time decides": "laws are compared by their median settling time",
    "the 99.9 % time decides": "laws are compared by the time in which 99.9 % of the starts settle",
    "the least effort decides": "laws are compared by the integral of the squared command",
    "times within 1 % are equal": "times that differ by up to 1 % count as equal",
    "times within 10 % are equal": "times that differ by up to 10 % count as equal",
}
"""What the table calls a rule where its short name needs the text."""

NOMINAL_IN_WORDS = (
    "The nominal situation has critical damping, no command limit, no delay, a control period of 0.01/√kp, the inertia "
    "of the model, no spin and no goal jump."
)
"""What `tasks.situation.NOMINAL` is."""

NEEDS = html.PageTable(
    "Your controller | Advised law | Why we advise this law | Price of this law | All laws compared"
)
LEAST = 0.01
"""The share of situations from which on a law has a row of its own."""


def facts(run: Run) -> dict[str, Any]:
    """Return the advice in a few sentences, the numbers about it, and regions, rules and other robots."""
    verdicts = decide_all()
    corrected = sensitivity.correct()
    halves, of = sensitivity.count_halves()
    held = sensitivity.count_agreeing()
    population, certificates = find_population(), read_certificates()
    proved = sum(one["is_proved"] for one in certificates.values())
    return {
        "lead": lead(),
        **describe_answer(),
        "ours": describe_ours(),
        "situations": len(verdicts),
        "drawn": sum(map(is_drawn, verdicts)),
        "episodes": f"{read_map()['starts'].sum() / 1e6:.1f}",
        "mapped": read_map()["contender"].nunique(),
        "first": FIRST,
        "most_starts": MOST,
        "spoken": f"{100 * SPOKEN:.0f}",
        "qualified": len(population.qualified),
        "excluded": together([families.word(law) for law in population.excluded], len(population.excluded)),
        "published": len(population.qualified) + len(population.excluded),
        "compared": corrected.compared,
        **{name: getattr(corrected, name) for name in ("won", "lost", "won_before", "lost_before")},
        "halves": describe_halves(halves, of),
        "of_halves": of,
        "slower": f"{100 * sensitivity.bound_slower(FIRST):.1f}",
        "noise": f"{NOISE_RAD:g}",
        "overshoot": f"{regions.OVERSHOOT:g}",
        "held": held.same.of,
        "same": str(held.same),
        "map_unbeaten": f"{100 * held.map.qualified.value:.0f}",
        "default_unbeaten": f"{100 * held.default.qualified.value:.0f}",
        "reliable": RELIABLE((_rated("the law of the map", held.map), _rated("always the default law", held.default))),
        "proved": count_of(proved, len(certificates), "laws"),
        "provable": len(certificates),
        "lines": words.describe_lines(find_regions()[0].law, families.word),
        "regions": REGIONS(_region(one) for one in find_regions() if one.advised >= LEAST),
        "rules": RULES(_rule(rule) for rule in sensitivity.vary()),
        "rules_same": count_same_rules(),
        "needs": in_run(lambda: NEEDS(list_needs())),
        "needs_finding": count_other_needs(),
        "weak": in_run(describe_weak_motors),
    }


def describe_weak_motors() -> str:
    """Say how often the advised law is near the least time where the command has a bound."""
    found = count_weak_motors(read_weak_motors())
    return (
        f"We drew {found.of} random situations with a bound of {found.low:.2g} to {found.high:.2g} kp. A law is "
        f"advised in {found.advised} of these. In {100 * found.near:.0f} % of the {found.advised} situations, the "
        f"advised law settles within {NEAR_LEAST:g} times the time of the fastest motions, and in "
        f"{100 * found.little:.0f} % it overshoots by less than {LITTLE_DEG:g}°"
    )


def lead() -> str:
    """Return which law to use, whose it is, and its price; or that this is not tested."""
    answer = find_answer()
    if not answer.is_tested:
        return "Which law to use is not tested: the map of situations is missing."
    law = f"**{families.word(answer.law)}**, {describe_attribution(answer.law)}"
    return f"Use {law}. The law {prose(call_laws(answer.price))}."


def describe_answer() -> dict[str, str]:
    """Return on which set the answer was tested, its condition, and what else is said of the law."""
    answer = find_answer()
    first, *others = find_regions()
    shares = [f"{families.word(region.law)} ({write_share(region.advised)})" for region in others]
    where = f"; in other situations the rule advises {together(shares, len(shares))}" if others else ""
    return {
        "reason": prose(call_laws(answer.reason)),
        "tested": prose(call_laws(answer.tested)),
        "condition": describe_condition(answer),
        "does": describe_default(),
        "advised": f"{families.word(first.law)} in {100 * first.advised:.0f} % of the situations{where}",
    }


def write_share(share: float) -> str:
    """Return a share in whole per cent."""
    return f"{100 * share:.0f} %" if share >= LEAST else f"less than {100 * LEAST:.0f} %"


def count_same_rules() -> str:
    """Say how many of the other rules advise the default most often."""
    rule, *others = sensitivity.vary()
    same = sum(other.law == rule.law for other in others)
    count = f"All {same}" if same == len(others) else f"{same or 'None'} of the {len(others)}"
    return f"{count} other rules advise {families.word(rule.law)} most often, as our rule does"


def count_other_needs() -> str:
    """Say for how many kinds of controllers another law than the default is advised."""
    default, *others = find_answer().needs
    laws = [*(need.law for need in others), list_elsewhere()[0].law]
    other = sum(law not in (default.law, NOT_TESTED) for law in laws)
    count = f"All {other}" if other == len(laws) else f"{other or 'None'} of the {len(laws)}"
    return (
        f"{count} kinds of controllers below the first row need another law than the law of the first row, "
        f"{families.word(default.law)}"
    )


def describe_halves(halves: int, of: int) -> str:
    """Say how many of the choices from a random half of the situations gave the default."""
    if halves == of:
        return f"All {of} choices gave the same law"
    return f"{halves or 'None'} of the {of} choices gave the same law"


def describe_condition(answer: Answer) -> str:
    """Return the condition of the answer, and how the command limits in the table of controllers differ from it.

    What the nominal situation is stands before the sentences that speak of it.
    """
    first, _, others = prose(call_laws(answer.condition)).partition(". ")
    sentences = [f"{first}.", NOMINAL_IN_WORDS, others]
    for need in answer.needs:
        if need.name == "weak-motors":
            law = families.word(need.law)
            sentences.append(
                f"The table below advises {law} for the command limits at which {law} is more than "
                f"{100 * SPOKEN:.0f} % faster than {families.word(answer.law)}."
            )
    return " ".join(sentences)


def list_needs() -> Iterator[tuple]:
    """Return a row for each kind of controller: the answer's, and of torques whose inertia is not cancelled."""
    for need in find_answer().needs:
        rows = html.MISSING
        if need.name in ROBOTS:
            page = find_page(ROBOTS[need.name].subject)
            rows = f'<a href="{page}.html">rows</a>'
        law = f"{_named(need.law)} ({need.attribution})" if need.law != NOT_TESTED else need.law
        yield prose(need.controller), law, prose(call_laws(need.why)), prose(call_laws(need.price)), rows
    uneven = list_elsewhere()[0]
    equals = together([f"“{families.word(law)}”" for law in uneven.tied])
    ties = f"Of these laws, “{families.word(uneven.law)}” and {equals} are equally good."
    alone = f"Of these laws, “{families.word(uneven.law)}” is the best."
    why = f"{uneven.compared} laws meet the requirements. {ties if uneven.tied else alone}"
    law = f"{_named(uneven.law)} ({find_contender(uneven.law).attribution})"
    yield "commands torque and does not cancel the inertia", law, why, html.MISSING, html.MISSING


def _rated(advice: str, rated: Rated) -> tuple[str, ...]:
    """Return the row of an advice in the held-out situations."""
    shares = str(rated.qualified), str(rated.all), str(rated.slower)
    return advice, *shares, f"{100 * rated.half:.1f}", f"{100 * rated.most:.0f}"


def _rule(rule: sensitivity.Varied) -> tuple:
    """Return the row of a rule."""
    name = RULE_WORDS.get(rule.words, rule.words)
    return name, _link(rule.law), 100 * rule.advised, 100 * rule.unbeaten, 100 * rule.changed


def _region(region: regions.Region) -> tuple:
    """Return the row of a region."""
    shares = measure_shares(region.law)
    return (
        _link(region.law),
        100 * region.advised,
        100 * shares.qualified.value,
        100 * shares.all.value,
        100 * shares.losing.value,
        describe_bounds(find_bounds(region.law)),
    )


def describe_default() -> str:
    """Return what the law of the widest region does."""
    law, rows = find_regions()[0].law, read_map()
    [row] = rows[(rows["situation"] == NOMINAL.word) & (rows["contender"] == law)].to_dict("records")
    return (
        f"With {families.word(law)}, kp = {KP:g}/s², critical damping and no bound, the body settles from every "
        "start that we tried. From 99 % of these starts the body settles within "
        f"{row['time'] / KP**0.5:.2f} s. Noise up to {NOISE_RAD:g} rad cannot keep the body at "
        f"180°. {words.describe_shares(law)}"
    )


def describe_ours() -> str:
    """Return how those of our own laws that are faster than the advised one somewhere compare with it."""
    return words.describe_ours(families.word)


def describe_attribution(law: str) -> str:
    """Return what a sentence calls a law: published, adapted or ours, in words."""
    return IN_WORDS[find_contender(law).attribution]


def _named(law: str) -> str:
    """Return a law with a link to its page."""
    return families.link(law, families.word(law))


def _link(law: str) -> str:
    """Return the same, and whether the law is ours."""
    ours = " (ours)" if facts_of(law).is_ours else ""
    return f"{_named(law)}{ours}"
