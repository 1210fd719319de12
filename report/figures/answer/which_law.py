"""The page that says which law to use: the map of situations, its regions, and what changes the advice."""

from __future__ import annotations

from typing import Any

from bench.experiments.situations import FIRST, MOST, NOISE_RAD
from bench.findings.claims import Results, judge
from bench.findings.selection import regions, sensitivity
from bench.findings.selection.regions import decide_all, facts_of, find_bounds, find_regions, is_drawn, read_map
from bench.findings.selection.robots import list_elsewhere
from bench.findings.selection.words import describe_bounds, together
from report.figures.kit import families
from report.figures.kit.page import Run
from report.figures.kit.tables import Table
from tasks.situation import KP, NOMINAL

REGIONS = Table("Law | Advised [%]:.0f | Nothing beats it [%]:.0f | One number at a time, nothing beats it")
RULES = Table("Rule | Law of the widest region | Advised [%]:.0f | Nothing beats it [%]:.0f | Advice changes [%]:.0f")
TUNED = Table(
    "Law | kv = 2√kp [1/√kp]:.2f | best zeta:.2f | its time [1/√kp]:.2f | best zeta at equal peak:.2f | "
    "its time [1/√peak]:.2f"
)
HELD_OUT = Table(
    "Held-out situations | Same law [%]:.0f | Nothing beats it [%]:.0f | Later, median [%]:.1f | Later, 95 % [%]:.1f"
)
ROBOTS_TABLE = Table("If | use | Tied with | Of laws | Measured")


def facts(run: Run) -> dict[str, Any]:
    """Return the advice in a few sentences, and the numbers about it."""
    verdicts = decide_all()
    beaten, left = sensitivity.correct()
    halves, of = sensitivity.count_halves()
    return {
        "lead": lead(run),
        "situations": len(verdicts),
        "drawn": sum(map(is_drawn, verdicts)),
        "episodes": f"{read_map()['starts'].sum() / 1e6:.1f}",
        "mapped": read_map()["contender"].nunique(),
        "first": FIRST,
        "most": MOST,
        "beaten": beaten,
        "left": left,
        "halves": halves,
        "of_halves": of,
        "slower": f"{100 * sensitivity.bound_slower(FIRST):.1f}",
        "noise": f"{NOISE_RAD:g}",
        "verdict": str(judge("C27", Results(run.folder)).word),
    }


def front_page(run: Run) -> str:
    """Return the advice in a few words."""
    one = find_regions()[0]
    word, rows = families.word(one.law), read_map()
    [row] = rows[(rows["situation"] == NOMINAL.word) & (rows["contender"] == one.law)].to_dict("records")
    return (
        f"{word[0].upper()}{word[1:]}, a published law, in simulation only: it settles from every start tried, noise "
        f"of orientation up to {NOISE_RAD:g} rad cannot trap it at 180°, and nothing published is faster in "
        f"{one.unbeaten:.0%} of the situations that were drawn at random. One number at a time that holds for "
        f"{describe_bounds(find_bounds(one.law))}. At kp = {KP:g} 1/s² and critical damping 99 % of the starts settle "
        f"in {row['time'] / KP**0.5:.2f} s. {_ours()}"
    )


def _ours() -> str:
    """Return how our own laws compare with what is advised."""
    said = []
    for law in regions.list_ours():
        ties, beats = regions.compare_ours(law)
        said.append(
            f"Our own law, {families.word(law)} (2026, not reviewed), is not advised: nothing published beats it in "
            f"{ties:.0%} of the situations, and it beats what is advised in {beats:.0%}."
        )
    return " ".join(said)


def lead(run: Run) -> str:
    """Return the front page's answer, and the laws of the other regions."""
    others = [f"{families.word(one.law)} ({one.advised:.0%})" for one in find_regions()[1:]]
    return f"{front_page(run)} Elsewhere: {together(others)}." if others else front_page(run)


def tables(run: Run) -> dict[str, Any]:
    """Return regions, rules, tuned laws, the held-out set, and other robots."""
    held = sensitivity.count_agreeing()
    return {
        "regions": REGIONS(_region(one) for one in find_regions()),
        "rules": RULES(
            (one.words, _link(one.law), 100 * one.advised, 100 * one.unbeaten, 100 * one.changed)
            for one in sensitivity.vary()
        ),
        "tuned": TUNED(
            (_link(one.law), one.at_one, one.zeta, one.time, one.peak_zeta, one.peak_time) for one in sensitivity.tune()
        ),
        "held_out": HELD_OUT([(held["of"], *(100 * held[name] for name in ("same", "unbeaten", "half", "most")))]),
        "robots": ROBOTS_TABLE(
            (
                one.words,
                _link(one.law),
                together([families.word(law) for law in one.tied]) if one.tied else "",
                str(one.compared or ""),
                f'<a href="{one.page}.html">rows</a>',
            )
            for one in list_elsewhere(run.folder)
        ),
    }


def _region(one: regions.Region) -> tuple:
    return _link(one.law), 100 * one.advised, 100 * one.unbeaten, describe_bounds(find_bounds(one.law))


def _link(law: str) -> str:
    ours = " (ours)" if facts_of(law).is_ours else ""
    return f"{families.link(law, families.word(law))}{ours}"
