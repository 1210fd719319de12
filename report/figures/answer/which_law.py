"""The page that says which law to use: the map of situations, its regions, and what changes the advice."""

from typing import Any

from bench.experiments.situations import FIRST, MOST, NOISE_RAD
from bench.findings.proofs.certificate import read_certificates
from bench.findings.selection import regions, sensitivity, words
from bench.findings.selection.regions import decide_all, facts_of, find_regions, is_drawn, read_map
from bench.findings.selection.robots import Elsewhere, list_elsewhere
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
from report.figures.kit.page import Run, in_run
from tasks.situation import KP, NOMINAL

REGIONS = html.Table(
    "Law | Advised [%]:.0f | Unbeaten among the qualified [%]:.0f | Unbeaten among all [%]:.0f | "
    "Loses starts [%]:.0f | No qualified law is faster, if one number changes, at"
)
RULES = html.Table("Rule | Law advised most | Advised [%]:.0f | Unbeaten [%]:.0f | Advice changes [%]:.0f")
TUNED = html.Table(
    "Law | kv = 2√kp [1/√kp]:.2f | best zeta:.2f | its time [1/√kp]:.2f | best zeta at equal peak:.2f | "
    "its time [1/√peak]:.2f"
)
LEAST = 0.01
"""The share of situations from which on a law has a row of its own."""
ROBOTS_TABLE = html.Table("If | use | Tied with | Laws compared | Rows")


def facts(run: Run) -> dict[str, Any]:
    """Return the advice in a few sentences, the numbers about it, and regions, rules, tuned laws and other robots."""
    verdicts = decide_all()
    corrected = sensitivity.correct()
    halves, of = sensitivity.count_halves()
    held = sensitivity.count_agreeing()
    population = find_population()
    return {
        "lead": lead(),
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
        "compared": f"{corrected.compared:,}",
        **{name: getattr(corrected, name) for name in ("won", "lost", "won_before", "lost_before")},
        "halves": halves,
        "of_halves": of,
        "slower": f"{100 * sensitivity.bound_slower(FIRST):.1f}",
        "noise": f"{NOISE_RAD:g}",
        "held": held.same.of,
        "same": str(held.same),
        **_rated("map", held.map),
        **_rated("default", held.default),
        "proved": sum(one["is_proved"] for one in read_certificates().values()),
        "provable": len(read_certificates()),
        "lines": words.describe_lines(find_regions()[0].law, families.word),
        "price": words.describe_price(find_regions()[0].law, called=families.word),
        "regions": REGIONS(_region(one) for one in find_regions() if one.advised >= LEAST),
        "rules": RULES(
            (one.words, _link(one.law), 100 * one.advised, 100 * one.unbeaten, 100 * one.changed)
            for one in sensitivity.vary()
        ),
        "tuned": TUNED((", ".join(map(_link, laws)), *numbers) for numbers, laws in _tuned().items()),
        "robots": in_run(lambda: ROBOTS_TABLE(map(describe_robot, list_elsewhere()))),
    }


def _rated(name: str, rated: Rated) -> dict[str, str]:
    """Return the numbers of an advice in the held-out situations."""
    return {
        f"{name}_qualified": str(rated.qualified),
        f"{name}_all": str(rated.all),
        f"{name}_slower": str(rated.slower),
        f"{name}_half": f"{100 * rated.half:.1f}",
        f"{name}_most": f"{100 * rated.most:.0f}",
    }


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
        f"With kp = {KP:g} 1/s², critical damping and no bound, the body settles from every start that we tried, "
        f"99 % of them within {row['time'] / KP**0.5:.2f} s, and noise up to {NOISE_RAD:g} rad cannot keep it at 180°. "
        f"{words.describe_shares(law)} {words.describe_price(law, called=families.word)}"
    )


def describe_ours() -> str:
    """Return how those of our own laws that are faster than the advised one somewhere compare with it."""
    return words.describe_ours(families.word)


def lead() -> str:
    """Return the default, and the laws of the other regions."""
    first, *others = find_regions()
    said = together([f"{families.word(one.law)} ({100 * one.advised:.0f} %)" for one in others])
    where = (
        f" Our rule (below) advises this law in {100 * first.advised:.0f} % of the situations; in others, {said}."
        if others
        else ""
    )
    law = f"**{families.word(first.law)}**, {describe_attribution(first.law)}"
    return f"Use {law}. {describe_default()}{where} {describe_ours()}"


def describe_attribution(law: str) -> str:
    """Return what a sentence calls a law: published, adapted or ours, in words."""
    return IN_WORDS[find_contender(law).attribution]


def _tuned() -> dict[tuple, list[str]]:
    """Return the laws that have the same numbers, as the table rounds them."""
    found: dict[tuple, list[str]] = {}
    for one in sensitivity.tune():
        numbers = one.at_one, one.zeta, one.time, one.peak_zeta, one.peak_time
        found.setdefault(tuple(round(float(number), 2) for number in numbers), []).append(one.law)
    return found


def describe_robot(one: Elsewhere) -> tuple:
    """Return the row of what leads to a law."""
    tied = together([families.word(law) for law in one.tied]) if one.tied else ""
    return one.words, _link(one.law), tied, str(one.compared or ""), f'<a href="{one.page}.html">rows</a>'


def _link(law: str) -> str:
    ours = " (ours)" if facts_of(law).is_ours else ""
    return f"{families.link(law, families.word(law))}{ours}"
