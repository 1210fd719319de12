"""The page that says which law to use: the map of situations, its regions, and what changes the advice."""

from typing import Any

from bench.experiments.situations import FIRST, MOST, NOISE_RAD
from bench.findings.proofs.certificate import read_certificates
from bench.findings.selection import regions, sensitivity
from bench.findings.selection.regions import decide_all, facts_of, find_bounds, find_regions, is_drawn, read_map
from bench.findings.selection.robots import Elsewhere, list_elsewhere
from bench.findings.selection.words import describe_bounds, together
from bench.law.attribution import IN_WORDS
from bench.law.contenders.registry import find_contender
from report.figures.kit import families, html
from report.figures.kit.page import Run, in_run
from tasks.situation import KP, NOMINAL

REGIONS = html.Table("Law | Advised [%]:.0f | Unbeaten [%]:.0f | Unbeaten, if one number changes, at")
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
    beaten, left = sensitivity.correct()
    halves, of = sensitivity.count_halves()
    held = sensitivity.count_agreeing()
    return {
        "lead": lead(),
        "situations": len(verdicts),
        "drawn": sum(map(is_drawn, verdicts)),
        "episodes": f"{read_map()['starts'].sum() / 1e6:.1f}",
        "mapped": read_map()["contender"].nunique(),
        "first": FIRST,
        "most_starts": MOST,
        "beaten": beaten,
        "left": left,
        "halves": halves,
        "of_halves": of,
        "slower": f"{100 * sensitivity.bound_slower(FIRST):.1f}",
        "noise": f"{NOISE_RAD:g}",
        "held": held["of"],
        "proved": sum(one["is_proved"] for one in read_certificates().values()),
        "provable": len(read_certificates()),
        "same": f"{100 * held['same']:.0f}",
        "unbeaten": f"{100 * held['unbeaten']:.0f}",
        "later": f"{100 * held['half']:.1f}",
        **{name: f"{100 * held[name]:.0f}" for name in ("most", "always_unbeaten", "always_most")},
        "regions": REGIONS(
            (_link(one.law), 100 * one.advised, 100 * one.unbeaten, describe_bounds(find_bounds(one.law)))
            for one in find_regions()
            if one.advised >= LEAST
        ),
        "rules": RULES(
            (one.words, _link(one.law), 100 * one.advised, 100 * one.unbeaten, 100 * one.changed)
            for one in sensitivity.vary()
        ),
        "tuned": TUNED((", ".join(map(_link, laws)), *numbers) for numbers, laws in _tuned().items()),
        "robots": in_run(lambda: ROBOTS_TABLE(map(describe_robot, list_elsewhere(run.folder)))),
    }


def describe_default() -> str:
    """Return what the law of the widest region does."""
    one, rows = find_regions()[0], read_map()
    [row] = rows[(rows["situation"] == NOMINAL.word) & (rows["contender"] == one.law)].to_dict("records")
    return (
        f"The body settles from every start that we tried, and noise up to {NOISE_RAD:g} rad cannot keep it at 180°. "
        "Of situations (gains, delays) drawn at random, no published or adapted law that meets the requirements is "
        f"faster in {100 * one.unbeaten:.0f} %. "
        f"With kp = {KP:g} 1/s² and critical damping, 99 % of the starts settle within {row['time'] / KP**0.5:.2f} s."
    )


def describe_ours() -> str:
    """Return how those of our own laws that are faster than the advised one somewhere compare with it."""
    said = []
    for law in regions.list_ours():
        ties, beats = regions.compare_ours(law)
        if not beats:
            continue
        said.append(
            f"We do not advise our own law, {families.word(law)} (2026, simulation only, not reviewed): in "
            f"{100 * (1 - ties):.0f} % of the situations a published or adapted law is faster. In {100 * beats:.0f} % "
            "our law is faster than the advised law."
        )
    return " ".join(said)


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
